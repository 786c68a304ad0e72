// Sines, tangents and their inverses.

#include <array>
#include <cmath>
#include <limits>

#include "engine/base/double_double.hpp"
#include "engine/base/mathematics.hpp"

namespace grainreel::math {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr DoubleDouble right_angle(0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54);  // pi / 2

constexpr double to_whole = 0x1.8p52;  // adding it rounds to a whole number

// An angle as quarters of a turn and a rest of at most pi / 4.
struct Reduced {
    int quarters;  // 0 to 3; whole turns are left out
    DoubleDouble rest;
};

// The sum of some numbers, as if computed with four times the digits (Ogita, Rump & Oishi 2005, SIAM J. Sci.
// Comput. 26, 1955: SumK). The sum may be much smaller than each of them.
template <std::size_t count>
DoubleDouble long_sum(std::array<double, count> terms) {
    for (int pass = 0; pass < 3; ++pass)
        for (std::size_t k = 1; k < count; ++k) {
            const DoubleDouble sum = exact_sum(terms[k], terms[k - 1]);
            terms[k] = sum.high, terms[k - 1] = sum.low;
        }
    double rest = 0;
    for (std::size_t k = 0; k + 1 < count; ++k) rest += terms[k];
    return exact_sum(terms.back(), rest);
}

// Subtracts n pi / 2 from an angle that is nearest to this. For |n| < 2^20 the first three of four parts of
// pi / 2 have so few digits (33) that their products with n are exact (Cody & Waite 1980). An angle of 53
// digits does not come nearer to a multiple of pi / 2 than about 2^-60, and four parts are right to 2^-137.
DoubleDouble without_quarters(double angle, double n) {
    if (std::abs(n) < 0x1p20) {
        constexpr double part[4] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2ep-69,
                                    0x1.b839a252049c1p-104};
        const DoubleDouble two = exact_sum(angle - n * part[0], -n * part[1]);
        const DoubleDouble three = exact_sum(two.high, -n * part[2]);
        return exact_sum(three.high, (three.low + two.low) - n * part[3]);
    }
    constexpr double part[4] = {0x1.921fb54442d18p+0, 0x1.1a62633145c06p-54, 0x1.c1cd129024e08p-107,
                                0x1.14cf98e804177p-160};
    const DoubleDouble one = exact_product(-n, part[0]), two = exact_product(-n, part[1]),
                       three = exact_product(-n, part[2]);
    return long_sum<8>({-n * part[3], three.low, three.high, two.low, two.high, one.low, one.high, angle});
}

// |angle| must be at most kLargestAngle.
Reduced reduced(double angle) {
    if (std::abs(angle) < 0x1.9p-1) return {0, angle};
    const double n = (angle * (1 / right_angle.high) + to_whole) - to_whole;
    return {static_cast<int>(n - 4 * std::floor(n / 4)), without_quarters(angle, n)};
}

// Sine and cosine of i / kParts for i = 0 ... kParts, each from the one before by a rotation.

constexpr int kParts = 64;

struct LongSineCosine {
    DoubleDouble sine, cosine;
};

constexpr std::array<LongSineCosine, kParts + 1> table_of_sines() {
    const DoubleDouble x = DoubleDouble(1) / kParts, square = x * x;
    DoubleDouble sine = 1, cosine = 1;  // Taylor's series of sin(x) / x and cos(x)
    for (int n = 16; n > 0; n -= 2) {
        sine = DoubleDouble(1) - square * sine / (n * (n + 1));
        cosine = DoubleDouble(1) - square * cosine / (n * (n - 1));
    }
    sine = x * sine;
    std::array<LongSineCosine, kParts + 1> table{};
    table[0] = {0, 1};
    for (int i = 1; i <= kParts; ++i) {
        const LongSineCosine& last = table[i - 1];
        table[i] = {last.sine * cosine + last.cosine * sine, last.cosine * cosine - last.sine * sine};
    }
    return table;
}
constexpr std::array<LongSineCosine, kParts + 1> kSines = table_of_sines();

// An angle of at most pi / 4 as one of the table and a rest: |more| <= 1 / (2 kParts).
struct Divided {
    LongSineCosine of_table;
    DoubleDouble more;
    double sine_less_more, one_less_cosine;  // of `more`
};

Divided divided(const DoubleDouble& angle) {
    const double i = (angle.high * kParts + to_whole) - to_whole;
    LongSineCosine of_table = kSines[static_cast<int>(std::abs(i))];
    if (i < 0) of_table.sine = -of_table.sine;
    const double more = angle.high - i * (1.0 / kParts), square = more * more;
    return {of_table,
            {more, angle.low},
            -more * square * (1.0 / 6 - square * (1.0 / 120 - square * (1.0 / 5040))),
            square * (1.0 / 2 - square * (1.0 / 24 - square * (1.0 / 720)))};
}

// `along` cos(more) + `across` sin(more).
DoubleDouble turned(const DoubleDouble& along, const DoubleDouble& across, const Divided& by) {
    const DoubleDouble change = exact_product(across.high, by.more.high);
    const DoubleDouble sum = exact_sum(along.high, change.high);
    const double small = across.high * by.sine_less_more - along.high * by.one_less_cosine;
    const double rest = change.low + along.low + across.low * by.more.high + across.high * by.more.low;
    return exact_sum_ordered(sum.high, sum.low + (small + rest));
}

DoubleDouble sine_of(const Divided& angle) {
    return turned(angle.of_table.sine, angle.of_table.cosine, angle);
}
DoubleDouble cosine_of(const Divided& angle) {
    return turned(angle.of_table.cosine, -angle.of_table.sine, angle);
}

LongSineCosine long_sin_cos(const Reduced& angle) {
    const Divided parts = divided(angle.rest);
    const DoubleDouble sine = sine_of(parts), cosine = cosine_of(parts);
    switch (angle.quarters) {
        case 0:
            return {sine, cosine};
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        default:
            return {-cosine, sine};
    }
}

// Sine of an angle that is `ahead` quarters of a turn further.
double sine_ahead(double angle, int ahead) {
    if (!(std::abs(angle) <= kLargestAngle)) return not_a_number;
    const Reduced r = reduced(angle);
    const Divided parts = divided(r.rest);
    const int quarters = (r.quarters + ahead) % 4;
    const double size = quarters % 2 == 0 ? sine_of(parts).high : cosine_of(parts).high;
    return quarters < 2 ? size : -size;
}

// Below this x and its sine are the same to the last digit.
constexpr double kTiny = 0x1p-30;

// The angle, up to pi / 4, whose tangent is y / x, with 0 <= y <= x and x > 0. Turning back by a guess leaves
// a small angle. The guess is the fourth convergent of Gauss' continued fraction of the arc tangent,
// within 2.4e-4.
DoubleDouble small_angle_of(const DoubleDouble& y, const DoubleDouble& x) {
    const double t = y.high / x.high, t2 = t * t;
    const double guess = t * (945 + t2 * (735 + t2 * 64)) / (945 + t2 * (1050 + t2 * 225));
    const LongSineCosine turn = long_sin_cos({0, guess});
    const double across = (y * turn.cosine - x * turn.sine).high;
    const double along = x.high * turn.cosine.high + y.high * turn.sine.high;
    const double d = across / along, d2 = d * d;
    return exact_sum_ordered(guess, d - d * d2 * (1.0 / 3 - d2 * 0.2));
}

// The angle, up to pi / 2, whose tangent is y / x, with neither negative and not both zero.
DoubleDouble angle_of(const DoubleDouble& y, const DoubleDouble& x) {
    return y.high <= x.high ? small_angle_of(y, x) : right_angle - small_angle_of(x, y);
}

DoubleDouble half_turn_less(const DoubleDouble& angle) {
    return DoubleDouble(2 * right_angle.high, 2 * right_angle.low) - angle;
}

// The other side of a right triangle whose hypotenuse is 1.
DoubleDouble other_side(double x) {
    return root_of(exact_sum(1, -x) * exact_sum(1, x));
}

}  // namespace

double sin(double angle) {
    return std::abs(angle) < kTiny ? angle : sine_ahead(angle, 0);
}

double cos(double angle) {
    return sine_ahead(angle, 1);
}

SineCosine sin_cos(double angle) {
    if (!(std::abs(angle) <= kLargestAngle)) return {not_a_number, not_a_number};
    if (std::abs(angle) < kTiny) return {angle, 1};
    const LongSineCosine both = long_sin_cos(reduced(angle));
    return {both.sine.high, both.cosine.high};
}

double tan(double angle) {
    if (!(std::abs(angle) <= kLargestAngle)) return not_a_number;
    if (std::abs(angle) < kTiny) return angle;
    const LongSineCosine both = long_sin_cos(reduced(angle));
    return (both.sine / both.cosine).high;
}

double asin(double x) {
    if (!(std::abs(x) <= 1)) return not_a_number;
    if (std::abs(x) < kTiny) return x;
    return std::copysign(angle_of(std::abs(x), other_side(x)).high, x);
}

double acos(double x) {
    if (!(std::abs(x) <= 1)) return not_a_number;
    const DoubleDouble angle = angle_of(other_side(x), std::abs(x));
    return x < 0 ? half_turn_less(angle).high : angle.high;
}

double atan(double x) {
    return atan2(x, 1);
}

double atan2(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return not_a_number;
    double up = std::abs(y), right = std::abs(x);
    if (std::isinf(up) && std::isinf(right)) up = right = 1;
    DoubleDouble angle = 0;
    if (right == 0 || std::isinf(up)) {
        if (up > 0) angle = right_angle;
    } else if (up > 0 && !std::isinf(right)) {
        constexpr int far = 64;  // so many powers of two apart, the smaller number does not count
        int exponent_up, exponent_right;
        std::frexp(up, &exponent_up), std::frexp(right, &exponent_right);
        if (exponent_up - exponent_right > far)
            angle = right_angle;
        else if (exponent_right - exponent_up > far)
            angle = up / right;
        else
            angle = angle_of(std::ldexp(up, -exponent_right), std::ldexp(right, -exponent_right));
    }
    return std::copysign(std::signbit(x) ? half_turn_less(angle).high : angle.high, y);
}

}  // namespace grainreel::math
