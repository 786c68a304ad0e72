// Expressions on grains: "species == big and height > 2 cm and speed < 1 mm/s".
//
// Numbers may have a unit, and dimensions are checked: a height is not compared with a time. This is why the
// parser is our own: the expression libraries at hand (muParser, exprtk) know plain numbers only.
//
// From the loosest to the tightest: or; and; not; < <= > >= == != (a < b < c is a < b and b < c); + -; * /;
// ^ with a plain whole number; functions abs, sqrt, min, max; touches(WHO), a condition; numbers, names,
// parentheses.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/text/units.hpp"

namespace grainreel {

// What a value is. Species can be compared for being equal, and nothing else.
struct ValueType {
    enum class Kind { number, truth, species };
    Kind kind = Kind::number;
    Powers powers{};  // of a number's dimension
};

// The words that an expression may use.
class Vocabulary {
  public:
    virtual ~Vocabulary() = default;
    struct Word {
        ValueType type;
        std::optional<double> constant;  // or empty: its value differs from grain to grain
        int column = -1;                 // of those that differ
    };
    virtual std::optional<Word> find(std::string_view name) const = 0;
    virtual std::vector<std::string> names() const = 0;  // for messages
    // The condition touches(who); none where there are no contacts to ask for. Throws UserError where `who`
    // is nothing that can be touched.
    virtual std::optional<Word> touching(std::string_view /*who*/) const { return std::nullopt; }
};

class Expression {
  public:
    // Throws UserError, which names the character (from 1) and what may stand there.
    Expression(std::string_view text, const Vocabulary& words);

    const ValueType& type() const { return nodes_.back().type; }
    // Columns of the vocabulary that it uses, each once.
    const std::vector<int>& columns() const { return columns_; }
    // SI; 1 or 0 of a truth. values: one a column of columns(), for one grain. NaN where a value is NaN; a
    // comparison with NaN is 0.
    double of(const std::vector<double>& values) const;

  private:
    friend class ExpressionParser;
    enum class Op {
        constant,
        column,
        either,
        both,
        opposite,
        less,
        less_equal,
        equal,
        unequal,
        plus,
        minus,
        times,
        over,
        negative,
        power,
        absolute,
        root,
        least,
        most
    };
    struct Node {
        Op op;
        ValueType type;
        double value = 0;                   // of a constant; the exponent of a power
        std::size_t first = 0, second = 0;  // nodes, or a place in columns_
    };
    double of(std::size_t node, const std::vector<double>& values) const;

    std::vector<Node> nodes_;  // what a node needs stands before it
    std::vector<int> columns_;
};

}  // namespace grainreel
