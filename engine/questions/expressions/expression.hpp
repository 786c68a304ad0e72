// Expressions on grains: "species == big and height > 2 cm and speed < 1 mm/s".
//
// Numbers may have a unit, and dimensions are checked: a height is not compared with a time. This is why
// grainreel has its own parser: the expression libraries at hand (muParser, exprtk) know plain numbers
// only.
//
// The operators, from the weakest to the strongest: or; and; not; < <= > >= == !=; + -; * /; ^ with a plain
// whole number. a < b < c means a < b and b < c. Operands are numbers, names, parentheses, the functions abs,
// sqrt, min and max, and the condition touches(WHO).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/text/units.hpp"

namespace grainreel {

// The type of a value. Species can only be compared for equality.
struct ValueType {
    enum class Kind { number, truth, species };
    Kind kind = Kind::number;
    Powers powers{};  // dimension of a number
};

// The words that an expression may use.
class Vocabulary {
  public:
    virtual ~Vocabulary() = default;
    struct Word {
        ValueType type;
        std::optional<double> constant;  // empty: its value differs from grain to grain
        int column = -1;                 // number of the column with its values
    };
    virtual std::optional<Word> find(std::string_view name) const = 0;
    virtual std::vector<std::string> names() const = 0;  // for messages
    // The condition touches(who); none where contacts are not known. Throws UserError where `who` is
    // nothing that can be touched.
    virtual std::optional<Word> touching(std::string_view /*who*/) const { return std::nullopt; }
};

class Expression {
  public:
    // Throws UserError, which gives the number of the character (from 1) and what may stand there.
    Expression(std::string_view text, const Vocabulary& words);

    const ValueType& type() const { return nodes_.back().type; }
    // The columns of the vocabulary that it uses, each once.
    const std::vector<int>& columns() const { return columns_; }
    // The value for one grain in SI; 1 or 0 for a condition. `values` has one number for each of columns().
    // The result is NaN where a value is NaN; a comparison with NaN is 0.
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
        double value = 0;                   // value of a constant, or exponent of a power
        std::size_t first = 0, second = 0;  // nodes, or a place in columns_
    };
    double of(std::size_t node, const std::vector<double>& values) const;

    std::vector<Node> nodes_;  // the nodes that a node needs stand before it
    std::vector<int> columns_;
};

// Parses the text of an expression into its nodes. The top of this file describes the language.

class ExpressionParser {
  public:
    ExpressionParser(std::string_view text, const Vocabulary& words, Expression& into)
        : text_(text), words_(words), into_(into) {}

    void parse();

  private:
    using Op = Expression::Op;
    using Kind = ValueType::Kind;

    // Each of these returns the node of what it has read.
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
    std::size_t inside();  // reads up to the closing parenthesis; the opening one has been read

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
    bool take(std::string_view symbol);     // reads a sign, if it comes next
    bool take_word(std::string_view word);  // reads a word, if it comes next
    std::string name_here();                // reads letters, digits and _; empty when there are none
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
bool is_plain(const Powers& powers);  // whether a number has no unit
// "a length"; "a number in m2.s-1" for a dimension without a name here.
std::string noun_of_powers(const Powers& powers);

}  // namespace grainreel
