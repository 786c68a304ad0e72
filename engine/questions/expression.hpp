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

// From the text of an expression to its nodes. See expression.hpp for the language.

class ExpressionParser {
  public:
    ExpressionParser(std::string_view text, const Vocabulary& words, Expression& into)
        : text_(text), words_(words), into_(into) {}

    void parse();

  private:
    using Op = Expression::Op;
    using Kind = ValueType::Kind;

    // Each returns the node of what it has read.
    std::size_t either();
    std::size_t both();
    std::size_t opposite();
    std::size_t comparison();
    std::size_t sum();
    std::size_t product();
    std::size_t negative();
    std::size_t power();
    std::size_t primary();
    std::size_t number();
    std::size_t word();
    std::size_t function(const std::string& name, std::size_t start);
    std::size_t touches(std::size_t start);
    std::size_t named(const std::string& name, std::size_t start);
    std::size_t add_word(const Vocabulary::Word& word);
    std::size_t quoted();
    std::size_t inside();  // what stands in parentheses, the first of them read

    std::optional<Op> comparing(bool& swapped);
    std::size_t compare(Op op, bool swapped, std::size_t left, std::size_t right, std::size_t start);
    double unit_here(Powers& powers);

    std::size_t add(Op op, ValueType type, std::size_t first = 0, std::size_t second = 0, double value = 0);
    const ValueType& type(std::size_t node) const { return into_.nodes_[node].type; }
    void want_number(std::size_t node, std::size_t start) const;
    void want_truth(std::size_t node, std::size_t start) const;
    bool is_zero(std::size_t node) const;  // a plain 0
    void want_alike(std::size_t left, std::size_t right, std::size_t start) const;

    void skip_spaces();
    bool take(std::string_view symbol);     // a sign, if it comes next
    bool take_word(std::string_view word);  // a word, if it comes next
    std::string name_here();                // letters, digits and _; empty when there are none
    [[noreturn]] void fail(std::size_t start, const std::string& what) const;

    std::string_view text_;
    const Vocabulary& words_;
    Expression& into_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

// Dimensions of numbers in words.

Powers powers_of(Dimension dimension);
bool same_powers(const Powers& a, const Powers& b);
bool is_plain(const Powers& powers);  // of a number without a unit
// "a length"; "a number in m2.s-1" for what has no name here.
std::string noun_of_powers(const Powers& powers);

}  // namespace grainreel
