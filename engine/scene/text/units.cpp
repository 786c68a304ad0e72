#include "engine/scene/text/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"

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

const UnitSystem& unit_system() {
    static const UnitSystem system;
    return system;
}

constexpr std::array<DimensionText, 20> dimension_texts{{
    {"m", "a length", "\"5 mm\"", 1e-12, 1e6},
    {"s", "a time", "\"10 s\"", 1e-30, 1e12},
    {"Hz", "a frequency", "\"25 Hz\"", 1e-12, 1e12},
    {"1/s", "a rate", "\"10 1/s\"", 0, 1e15},
    {"rad", "an angle", "\"20 deg\"", 1e-9, 1e6},
    {"turn", "a phase", "\"90 deg\"", 0, 1e9},
    {"degree", "an angle", "\"20 deg\"", 0, 1e6},
    {"kg/m3", "a density", "\"2.5 g/cm3\"", 1e-6, 1e9},
    {"kg", "a mass", "\"0.16 g\"", 1e-30, 1e12},
    {"N/m", "a stiffness", "\"2e4 N/m\"", 1e-30, 1e30},
    {"Pa", "a pressure", "\"70 GPa\"", 1e-30, 1e30},
    {"m/s", "a speed", "\"0.5 m/s\"", 1e-12, 1e6},
    {"rad/s", "an angular velocity", "\"10 rad/s\"", 0, 1e12},
    {"m/s2", "an acceleration", "\"9.81 m/s2\"", 0, 1e6},
    {"J", "an energy", "\"5 µJ\"", 0, 1e30},
    {"N", "a force", "\"10 mN\"", 0, 1e30},
    {"N.m", "a moment", "\"1 N.m\"", 0, 1e30},
    {"1", "a plain number", "0.5", 0, 1e30},
    {"kg/s", "a mass flow", "\"10 g/s\"", 0, 1e30},
    {"W", "a power", "\"1 mW\"", 0, 1e30},
}};

// Whether a text can be a unit: it begins with a letter or with "1/", and no number follows a space.
// udunits would take "1 000 mm" for 1 times 000 mm, and "mm 3" for three of them.
bool looks_like_unit(std::string_view text) {
    if (text.empty()) return false;
    if (text.substr(0, 2) == "1/") text.remove_prefix(2);
    const auto first = static_cast<unsigned char>(text.empty() ? ' ' : text.front());
    if (!std::isalpha(first) && first < 0x80) return false;
    for (std::size_t i = 0; i + 1 < text.size(); ++i)
        if (std::isspace(static_cast<unsigned char>(text[i])) &&
            !std::isalpha(static_cast<unsigned char>(text[i + 1])) &&
            static_cast<unsigned char>(text[i + 1]) < 0x80)
            return false;
    return text.find('@') == std::string_view::npos;
}

// A value times the size of its unit. 4.5 mm is 4.5 / 1000 and not 4.5 * 0.001, which is one ulp off. 2.5
// g/cm3 are 2500 kg/m3, where udunits has a factor of 999.9999999999998.
double scaled(double value, double scale) {
    constexpr double rounding = 1e-13;
    const double parts = std::round(1 / scale), times = std::round(scale);
    if (parts > 1 && std::abs(parts * scale - 1) < rounding) return value / parts;
    return times >= 1 && std::abs(scale / times - 1) < rounding ? value * times : value * scale;
}

// The text with a point in place of the comma of its number; nothing for a text without one. "9,5 mm" is how
// a half is written in much of Europe.
std::optional<std::string> with_decimal_point(std::string_view text) {
    const std::size_t comma = text.find(',');
    const auto is_digit = [&](std::size_t i) {
        return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
    };
    if (comma == 0 || comma == std::string_view::npos || !is_digit(comma - 1) || !is_digit(comma + 1))
        return std::nullopt;
    std::string mended(text);
    mended[comma] = '.';
    return mended;
}

// " is a time" for a unit of another known dimension, else " is not".
std::string other_dimension(const Unit& unit) {
    for (const DimensionText& other : dimension_texts)
        if (UnitSystem::factor(unit, unit_system().parse(other.unit)))
            return fmt::format(" is {}", other.noun);
    return " is not";
}

// A unit in base units: "m.kg.s-2" without its factor.
std::string base_units(const Unit& unit) {
    std::array<char, 256> definition{};
    if (ut_format(unit.get(), definition.data(), definition.size() - 1, UT_ASCII | UT_DEFINITION) < 0)
        return "none";
    std::string_view text = definition.data();
    const std::size_t space = text.find(' ');
    if (space != std::string_view::npos) text.remove_prefix(space + 1);
    // The definition of a pure number has no units at all.
    return std::string(text.find_first_not_of("0123456789.eE+-") == std::string_view::npos ? "" : text);
}

std::optional<Powers> powers_of(std::string_view base) {
    constexpr std::array<std::string_view, 4> names = {"m", "kg", "s", "rad"};
    Powers powers{};
    while (!base.empty()) {
        const std::string_view part = base.substr(0, base.find('.'));
        base.remove_prefix(std::min(base.size(), part.size() + 1));
        const std::size_t letters = std::min(part.size(), part.find_first_of("-0123456789"));
        const auto name = std::find(names.begin(), names.end(), part.substr(0, letters));
        if (name == names.end()) return std::nullopt;
        int power = 1;
        if (letters < part.size()) std::from_chars(part.data() + letters, part.data() + part.size(), power);
        powers[static_cast<std::size_t>(name - names.begin())] += power;
    }
    return powers;
}

}  // namespace

std::optional<AnyUnit> parse_unit(std::string_view text) {
    const std::lock_guard guard(units_lock);
    const Unit unit = looks_like_unit(text) ? unit_system().parse(std::string(text)) : Unit();
    if (!unit) return std::nullopt;
    const std::string base = base_units(unit);
    const std::optional<Powers> powers = powers_of(base);
    if (!powers) return std::nullopt;
    const std::optional<double> size =
        UnitSystem::factor(unit, unit_system().parse(base.empty() ? "1" : base));
    if (!size) return std::nullopt;
    return AnyUnit{*size, *powers};
}

const DimensionText& text_of(Dimension dimension) {
    return dimension_texts[static_cast<std::size_t>(dimension)];
}

double parse_quantity(std::string_view text, Dimension dimension, const std::string& example) {
    const DimensionText& wanted = text_of(dimension);
    const auto fail = [&](const std::string& what) -> UserError {
        return UserError("must be {}, but {}; write for example {}", wanted.noun, what,
                         example.empty() ? wanted.example : example);
    };
    const std::string_view all = trimmed(text);
    const std::string shown = excerpt(text);
    double value = 0;
    const auto [end, failure] = std::from_chars(all.data(), all.data() + all.size(), value);
    if (failure != std::errc() || !std::isfinite(value))
        throw fail(fmt::format("\"{}\" does not begin with a number", shown));
    const std::string unit_text(trimmed(all.substr(static_cast<std::size_t>(end - all.data()))));
    if (const std::optional<std::string> mended = with_decimal_point(all))
        throw UserError(
            "must be {}, but \"{}\" has a comma in its number; write {}", wanted.noun, shown,
            std::isdigit(static_cast<unsigned char>(mended->back())) ? *mended : '"' + *mended + '"');
    if (dimension == Dimension::number)
        throw fail(unit_text.empty() ? fmt::format("\"{}\" is text; leave the quotes out", shown)
                                     : fmt::format("\"{}\" has a unit", shown));
    if (unit_text.empty()) throw fail(fmt::format("\"{}\" has no unit", shown));

    const std::lock_guard guard(units_lock);
    const Unit unit = looks_like_unit(unit_text) ? unit_system().parse(unit_text) : Unit();
    if (!unit) throw fail(fmt::format("\"{}\" has the unknown unit \"{}\"", shown, excerpt(unit_text)));
    const std::optional<double> scale = UnitSystem::factor(unit, unit_system().parse(wanted.unit));
    if (!scale) throw fail(fmt::format("\"{}\"{}", shown, other_dimension(unit)));
    return scaled(value, *scale);
}

std::optional<double> unit_size_in(std::string_view text, Dimension dimension) {
    if (!looks_like_unit(text)) return std::nullopt;
    const std::lock_guard guard(units_lock);
    const Unit unit = unit_system().parse(std::string(text));
    if (!unit) return std::nullopt;
    const std::optional<double> scale =
        UnitSystem::factor(unit, unit_system().parse(text_of(dimension).unit));
    return scale ? std::optional(scaled(1, *scale)) : std::nullopt;
}

namespace {

std::vector<std::string> usual_units(Dimension dimension) {
    switch (dimension) {
        case Dimension::length:
            return {"m", "mm", "µm"};
        case Dimension::speed:
            return {"m/s", "mm/s", "µm/s"};
        case Dimension::energy:
            return {"J", "mJ", "µJ", "nJ"};
        case Dimension::force:
            return {"kN", "N", "mN", "µN"};
        case Dimension::mass:
            return {"kg", "g", "mg", "µg"};
        case Dimension::moment:
            return {"N.m", "mN.m", "µN.m", "nN.m"};
        case Dimension::pressure:
            return {"MPa", "kPa", "Pa"};
        case Dimension::mass_flow:
            return {"kg/s", "g/s", "mg/s"};
        case Dimension::power:
            return {"W", "mW", "µW", "nW"};
        case Dimension::number:
            return {""};
        default:
            return {text_of(dimension).unit};
    }
}

}  // namespace

double unit_size(const std::string& unit, Dimension dimension) {
    return unit.empty() ? 1.0 : parse_quantity("1 " + unit, dimension);
}

std::string fitting_unit(double value, Dimension dimension) {
    const std::vector<std::string> units = usual_units(dimension);
    for (const std::string& unit : units)
        if (std::abs(value) >= 0.5 * unit_size(unit, dimension)) return unit;
    return units.back();
}

std::optional<std::int64_t> parse_data_size(const std::string& text) {
    double number = 0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number, std::chars_format::fixed);
    if (read.ec != std::errc()) return std::nullopt;
    std::string_view unit(read.ptr, static_cast<std::size_t>(end - read.ptr));
    while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
    constexpr double k = 1000, ki = 1024;
    const std::array<std::pair<std::string_view, double>, 7> units{{{"B", 1},
                                                                    {"kB", k},
                                                                    {"MB", k * k},
                                                                    {"GB", k * k * k},
                                                                    {"KiB", ki},
                                                                    {"MiB", ki * ki},
                                                                    {"GiB", ki * ki * ki}}};
    for (const auto& [name, bytes] : units) {
        const double size = number * bytes;
        if (unit == name && size >= 1 && size < 1e15) return static_cast<std::int64_t>(std::floor(size));
    }
    return std::nullopt;
}

std::string data_size_text(double bytes) {
    constexpr std::array<const char*, 5> units{"B", "kB", "MB", "GB", "TB"};
    std::size_t unit = 0;
    for (; bytes >= 1000 && unit + 1 < units.size(); ++unit) bytes /= 1000;
    return fmt::format("{:.3g} {}", bytes, units[unit]);
}

}  // namespace grainreel
