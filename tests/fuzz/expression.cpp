// Expressions on grains, with units, names and species; what is one is worked out for a grain.
#include "engine/questions/expressions/expression.hpp"
#include "engine/base/error.hpp"
#include "tests/fuzz/targets.hpp"

namespace grainreel::fuzz {

namespace {

class FewWords final : public Vocabulary {
  public:
    std::optional<Word> find(std::string_view name) const override {
        using Kind = ValueType::Kind;
        if (name == "height") return Word{{Kind::number, {1, 0, 0, 0}}, {}, 0};
        if (name == "speed") return Word{{Kind::number, {1, 0, -1, 0}}, {}, 1};
        if (name == "contacts") return Word{{Kind::number, {}}, {}, 2};
        if (name == "species") return Word{{Kind::species, {}}, {}, 3};
        if (name == "big") return Word{{Kind::species, {}}, 1.0, -1};
        return std::nullopt;
    }
    std::vector<std::string> names() const override {
        return {"height", "speed", "contacts", "species", "big"};
    }
};

void attempt_expression(std::string_view bytes) {
    try {
        const Expression expression(bytes, FewWords());
        expression.of(std::vector<double>(expression.columns().size(), 1.5));
    } catch (const UserError&) {
    }
}

}  // namespace

Target expression_target() {
    return {"expression", "expressions on grains", attempt_expression};
}

}  // namespace grainreel::fuzz
