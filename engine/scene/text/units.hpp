// Quantities with units, such as "2 mm" or "25 Hz", read with the udunits2 library; and sizes of files.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace grainreel {

// What a quantity measures. The order is that of dimension_texts in units.cpp. There are three dimensions of
// angles: in rad, in turns (phases of the drive), and in degrees (camera).
enum class Dimension {
    length,
    time,
    frequency,
    rate,
    angle,
    phase,
    degrees,
    density,
    mass,
    stiffness,
    pressure,
    speed,
    spin,
    acceleration,
    energy,
    force,
    moment,
    number,
    mass_flow,
    power,
};

struct DimensionText {
    const char* unit;     // unit of plain numbers, as udunits writes it; "1" for a pure number
    const char* noun;     // "a length"
    const char* example;  // "\"5 mm\"", as a scene would say it
    // Bounds in that unit. Values beyond them are surely mistakes, and products of several values would
    // overflow.
    double least, most;  // `least` is for values that must be larger than 0
};
const DimensionText& text_of(Dimension dimension);

// The value of `text` in the dimension's unit. Throws UserError without the place and the name of the key:
// "must be a length, but \"2 s\" is a time; write for example \"5 mm\"", with `example` when there is one.
// Safe from several threads.
double parse_quantity(std::string_view text, Dimension dimension, const std::string& example = "");

// Powers of m, kg, s and rad. A radian is a dimension of its own, so that 25 rad/s is not 25 Hz.
using Powers = std::array<double, 4>;

struct AnyUnit {
    double size = 1;  // in SI: 0.01 for "cm"
    Powers powers{};
};
// Empty for text that is no unit, and for units of other dimensions (temperature, current). Safe from
// several threads.
std::optional<AnyUnit> parse_unit(std::string_view text);

// The size of a unit in the dimension's own: 0.001 for "mm" of a length. None for other words, and for units
// that measure something else. Safe from several threads.
std::optional<double> unit_size_in(std::string_view text, Dimension dimension);

// Units in which a number reads well.

// The size of `unit` in SI: 0.01 for "cm/s"; 1 for an empty text. Throws UserError, without a place, when
// it is not a unit of the dimension.
double unit_size(const std::string& unit, Dimension dimension);

// The largest of the dimension's usual units in which `value` is not below 0.5; for smaller values the
// smallest unit.
std::string fitting_unit(double value, Dimension dimension);

// Sizes of files: "10 MB".

// Bytes of "10 MB", "1.5GB" or "9 MiB", rounded down: B, kB, MB and GB count by thousands, KiB, MiB and GiB
// by 1024. None where the text is no positive size.
std::optional<std::int64_t> parse_data_size(const std::string& text);

// Text for a size, by thousands: "9.31 MB".
std::string data_size_text(double bytes);

}  // namespace grainreel
