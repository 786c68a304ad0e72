// From the text of an expression to its nodes. See expression.hpp for the language.
#pragma once

#include <string>
#include <string_view>

#include "engine/questions/expression.hpp"

namespace grainreel {

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
    bool take_word(std::string_view word);  // likewise a word
    std::string name_here();                // letters, digits and _; empty when there are none
    [[noreturn]] void fail(std::size_t start, const std::string& what) const;

    std::string_view text_;
    const Vocabulary& words_;
    Expression& into_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

}  // namespace grainreel
