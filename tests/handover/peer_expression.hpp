// Evaluates expressions of LAMMPS' input language: numbers, v_ names, + - * /, comparisons, brackets, sin,
// cos, floor, ceil. Comparisons bind weaker than sums, as there.
#pragma once

#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>

namespace grainreel::test {

class PeerExpression {
  public:
    using Values = std::map<std::string, double>;
    static double value(const std::string& text, const Values& values) {
        PeerExpression parser(text, values);
        const double result = parser.comparison();
        if (parser.at_ != text.size()) throw std::runtime_error("not understood: " + text.substr(parser.at_));
        return result;
    }

  private:
    PeerExpression(const std::string& text, const Values& values) : text_(text), values_(values) {}

    bool take(const std::string& word) {
        if (text_.compare(at_, word.size(), word) != 0) return false;
        at_ += word.size();
        return true;
    }
    double comparison() {
        double left = sum();
        for (;;) {
            if (take(">="))
                left = left >= sum();
            else if (take("<="))
                left = left <= sum();
            else if (take(">"))
                left = left > sum();
            else if (take("<"))
                left = left < sum();
            else
                return left;
        }
    }
    double sum() {
        double left = product();
        for (;;) {
            if (take("+"))
                left += product();
            else if (take("-"))
                left -= product();
            else
                return left;
        }
    }
    double product() {
        double left = factor();
        for (;;) {
            if (take("*"))
                left *= factor();
            else if (take("/"))
                left /= factor();
            else
                return left;
        }
    }
    double bracket() {
        const double inside = comparison();
        if (!take(")")) throw std::runtime_error("no bracket closes: " + text_);
        return inside;
    }
    double factor() {
        if (take("-")) return -factor();
        if (take("(")) return bracket();
        if (take("sin(")) return std::sin(bracket());
        if (take("cos(")) return std::cos(bracket());
        if (take("floor(")) return std::floor(bracket());
        if (take("ceil(")) return std::ceil(bracket());
        const std::size_t begin = at_;
        while (at_ < text_.size() &&
               (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
            ++at_;
        const std::string word = text_.substr(begin, at_ - begin);
        const std::string name = word.rfind("v_", 0) == 0 ? word.substr(2) : word;
        if (const auto found = values_.find(name); found != values_.end()) return found->second;
        at_ = begin;
        char* end = nullptr;
        const double number = std::strtod(text_.c_str() + begin, &end);
        at_ = static_cast<std::size_t>(end - text_.c_str());
        if (at_ == begin) throw std::runtime_error("unknown: " + text_.substr(begin));
        return number;
    }

    const std::string& text_;
    const Values& values_;
    std::size_t at_ = 0;
};

}  // namespace grainreel::test
