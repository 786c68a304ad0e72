#include "engine/scene/text/unit_system.hpp"

#include <udunits2.h>
#include <array>
#include <memory>
#include <mutex>
#include <string_view>

#include "engine/base/error.hpp"

namespace grainreel {

namespace {

struct FreeUnit {
    void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

// The table of units that udunits installs beside itself. Its location is compiled into the library, or given
// by UDUNITS2_XML_PATH. udunits keeps global state, so every use takes units_lock.
class UnitSystem {
  public:
    UnitSystem() {
        ut_set_error_message_handler(ut_ignore);  // it would print to stderr
        system_ = ut_read_xml(nullptr);
        if (system_ == nullptr)
            throw UserError(
                "the units database udunits2.xml is missing; install the package libudunits2-data or set "
                "UDUNITS2_XML_PATH to the file");
        // udunits knows degrees by name and by the degree sign only, and revolutions by name.
        if (const Unit degree = parse("degree")) ut_map_symbol_to_unit("deg", UT_ASCII, degree.get());
        if (const Unit turn = parse("revolution")) ut_map_symbol_to_unit("rev", UT_ASCII, turn.get());
    }
    ~UnitSystem() { ut_free_system(system_); }
    UnitSystem(const UnitSystem&) = delete;
    UnitSystem& operator=(const UnitSystem&) = delete;

    Unit parse(const std::string& text) const { return Unit(ut_parse(system_, text.c_str(), UT_UTF8)); }

    // The factor from `from` to `to`; none when they measure different things. For udunits the radian is 1,
    // and 25 rad/s would pass as 25 Hz; here it is a dimension of its own.
    static std::optional<double> factor(const Unit& from, const Unit& to) {
        if (!ut_are_convertible(from.get(), to.get())) return std::nullopt;
        const Unit ratio(ut_divide(from.get(), to.get()));
        std::array<char, 256> definition{};
        if (!ratio ||
            ut_format(ratio.get(), definition.data(), definition.size() - 1, UT_ASCII | UT_DEFINITION) < 0)
            return std::nullopt;
        if (std::string_view(definition.data()).find("rad") != std::string_view::npos) return std::nullopt;
        const std::unique_ptr<cv_converter, void (*)(cv_converter*)> converter(
            ut_get_converter(from.get(), to.get()), cv_free);
        if (!converter || cv_convert_double(converter.get(), 0) != 0) return std::nullopt;  // no offsets
        return cv_convert_double(converter.get(), 1);
    }

  private:
    ut_system* system_ = nullptr;
};

std::mutex units_lock;

const UnitSystem& units_of_udunits() {
    static const UnitSystem system;
    return system;
}

std::string definition_of(const Unit& unit) {
    std::array<char, 256> definition{};
    if (ut_format(unit.get(), definition.data(), definition.size() - 1, UT_ASCII | UT_DEFINITION) < 0)
        return "none";
    std::string_view text = definition.data();
    const std::size_t space = text.find(' ');
    if (space != std::string_view::npos) text.remove_prefix(space + 1);
    // The definition of a pure number has no units at all.
    return std::string(text.find_first_not_of("0123456789.eE+-") == std::string_view::npos ? "" : text);
}

}  // namespace

bool unit_system::knows(const std::string& unit) {
    const std::lock_guard guard(units_lock);
    return units_of_udunits().parse(unit) != nullptr;
}

std::optional<double> unit_system::factor(const std::string& from, const std::string& to) {
    const std::lock_guard guard(units_lock);
    const Unit one = units_of_udunits().parse(from), other = units_of_udunits().parse(to);
    return one && other ? UnitSystem::factor(one, other) : std::nullopt;
}

std::optional<std::string> unit_system::base_units(const std::string& unit) {
    const std::lock_guard guard(units_lock);
    const Unit parsed = units_of_udunits().parse(unit);
    return parsed ? std::optional(definition_of(parsed)) : std::nullopt;
}

}  // namespace grainreel
