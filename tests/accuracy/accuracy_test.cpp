// Compares engine/base/mathematics.hpp with MPFR, which rounds correctly. Errors are in units of the last
// place of the correct result. The quick test takes some thousand arguments of each kind, and AccuracyLong
// takes so many that the table in mathematics.hpp can be made from what it prints (with
// --gtest_filter='*AccuracyLong*').
#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/mathematics.hpp"

namespace grainreel {
namespace {

using Arguments = std::pair<double, double>;  // functions of one argument ignore the second

// A number of MPFR, with enough digits that it is right beside a double.
class Long {
  public:
    Long() { mpfr_init2(value_, 320); }
    explicit Long(double x) : Long() { mpfr_set_d(value_, x, MPFR_RNDN); }
    ~Long() { mpfr_clear(value_); }
    Long(const Long&) = delete;
    Long& operator=(const Long&) = delete;
    operator mpfr_ptr() { return value_; }

  private:
    mpfr_t value_;
};

// The distance between neighbouring doubles at a size.
double unit_at(double x) {
    int exponent;
    std::frexp(x, &exponent);
    return std::ldexp(1, std::max(exponent - 53, -1074));
}

// Error of a result, in units of the last place. A result that is infinite or zero has no error if the
// correct one, rounded, is the same.
double error_of(double is, Long& should) {
    const double rounded = mpfr_get_d(should, MPFR_RNDN);
    if (is == rounded && (std::isinf(is) || is == 0)) return 0;
    if (!std::isfinite(is) || !std::isfinite(rounded)) return std::numeric_limits<double>::infinity();
    const double unit = unit_at(mpfr_get_d(should, MPFR_RNDZ));
    mpfr_sub_d(should, should, is, MPFR_RNDN);
    mpfr_div_d(should, should, unit, MPFR_RNDN);
    return std::abs(mpfr_get_d(should, MPFR_RNDN));
}

struct Function {
    const char* name;
    std::function<double(Arguments)> ours;
    std::function<void(Long&, Arguments)> exact;
    std::vector<std::function<Arguments()>> arguments;  // each draws one kind of them
    std::vector<Arguments> hard;
    double most = 0.515;  // the error that the header promises
    int rarer = 1;        // how many times fewer arguments, where MPFR takes long
};

// Random numbers, spread evenly over a range or over its orders of magnitude, of either sign.
class Draw {
  public:
    double share() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double even(double low, double high) { return low + (high - low) * share(); }
    double sign() { return engine_() & 1 ? 1 : -1; }
    double over(double lowest_power, double highest_power) {
        return std::exp2(even(lowest_power, highest_power));
    }

  private:
    std::mt19937_64 engine_{7};
};

// Angles of 53 digits that come nearest to multiples of pi / 2: for each power of two 2^e, whole numbers m
// for which m 2^e / (pi / 2) is nearly whole. They are the denominators of the continued fraction of 2^e /
// (pi / 2).
std::vector<Arguments> angles_near_quarters() {
    std::vector<Arguments> angles;
    for (int exponent = -52; exponent <= -3; ++exponent) {
        Long rest, whole;
        mpfr_const_pi(rest, MPFR_RNDN);
        mpfr_ui_div(rest, 2, rest, MPFR_RNDN);
        mpfr_mul_2si(rest, rest, exponent, MPFR_RNDN);
        double before = 0, denominator = 1;
        for (;;) {
            mpfr_floor(whole, rest);
            mpfr_sub(rest, rest, whole, MPFR_RNDN);
            mpfr_ui_div(rest, 1, rest, MPFR_RNDN);
            mpfr_floor(whole, rest);
            const double next = mpfr_get_d(whole, MPFR_RNDN) * denominator + before;
            if (!(next < 0x1p53)) break;
            before = std::exchange(denominator, next);
            angles.push_back({std::ldexp(denominator, exponent), 0});
        }
    }
    return angles;
}

template <int of(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t)>
void exact_one(Long& result, Arguments a) {
    of(result, Long(a.first), MPFR_RNDN);
}
template <int of(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t)>
void exact_two(Long& result, Arguments a) {
    of(result, Long(a.first), Long(a.second), MPFR_RNDN);
}
template <double of(double)>
double our_one(Arguments a) {
    return of(a.first);
}
template <double of(double, double)>
double our_two(Arguments a) {
    return of(a.first, a.second);
}

std::vector<Function> circular(Draw& d) {
    const std::vector<std::function<Arguments()>> angles{
        [&] { return Arguments(d.even(-0.8, 0.8), 0); }, [&] { return Arguments(d.even(-7, 7), 0); },
        [&] { return Arguments(d.even(-1e6, 1e6), 0); },
        [&] { return Arguments(d.even(-0x1p50, 0x1p50), 0); },
        [&] { return Arguments(d.sign() * d.over(-1074, 50), 0); }};
    const std::vector<std::function<Arguments()>> shares{
        [&] { return Arguments(d.even(-1, 1), 0); },
        [&] { return Arguments(d.sign() * d.over(-1074, 0), 0); },
        [&] { return Arguments(d.sign() * (1 - d.over(-53, 0)), 0); }};
    const std::vector<std::function<Arguments()>> all{
        [&] { return Arguments(d.even(-3, 3), 0); }, [&] { return Arguments(d.sign() * d.over(-80, 80), 0); },
        [&] { return Arguments(d.sign() * d.over(-1074, 1024), 0); }};
    const std::vector<std::function<Arguments()>> planes{
        [&] { return Arguments(d.even(-1, 1), d.even(-1, 1)); },
        [&] { return Arguments(d.sign() * d.over(-70, 70), d.sign() * d.over(-70, 70)); },
        [&] { return Arguments(d.sign() * d.over(-1074, 1024), d.sign() * d.over(-1074, 1024)); }};
    const std::vector<Arguments> hard = angles_near_quarters();
    return {{"sin", our_one<math::sin>, exact_one<mpfr_sin>, angles, hard},
            {"cos", our_one<math::cos>, exact_one<mpfr_cos>, angles, hard},
            {"tan", our_one<math::tan>, exact_one<mpfr_tan>, angles, hard},
            {"asin", our_one<math::asin>, exact_one<mpfr_asin>, shares, {}},
            {"acos", our_one<math::acos>, exact_one<mpfr_acos>, shares, {}},
            {"atan", our_one<math::atan>, exact_one<mpfr_atan>, all, {}},
            {"atan2", our_two<math::atan2>, exact_two<mpfr_atan2>, planes, {}},
            {"hypot",
             our_two<math::hypot>,
             exact_two<mpfr_hypot>,
             planes,
             {{1e-323, 1.5e-323}, {1e308, 1.4e308}}}};
}

std::vector<Function> exponential(Draw& d) {
    const std::vector<std::function<Arguments()>> exponents{
        [&] { return Arguments(d.even(-746, 710), 0); }, [&] { return Arguments(d.even(-2, 2), 0); },
        [&] { return Arguments(d.even(-746, -707), 0); },  // results with fewer digits
        [&] { return Arguments(d.sign() * d.over(-1074, 9.4), 0); }};
    const std::vector<std::function<Arguments()>> positive{
        [&] { return Arguments(d.over(-1074, 1024), 0); }, [&] { return Arguments(d.even(0.5, 2), 0); },
        [&] { return Arguments(1 + d.sign() * d.over(-52, -3), 0); }};
    // A base and an exponent whose power is e^x.
    const auto power = [](double base, double x) { return Arguments(base, x / std::log(base)); };
    const std::vector<std::function<Arguments()>> powers{
        [&] { return Arguments(d.share(), d.even(0, 3)); },
        [&] { return Arguments(d.over(-1074, 1024), d.even(-1, 1)); },
        [&] { return Arguments(d.even(-100, 100), std::floor(d.even(-20, 20))); },
        [&, power] { return power(d.over(-3, 3), d.even(-746, 710)); },
        [&, power] { return power(1 + d.sign() * d.over(-50, -2), d.even(-746, 710)); },
        [&, power] { return power(d.over(-1074, 1024), d.even(-746, -707)); }};
    const std::vector<std::function<Arguments()>> roots{
        [&] { return Arguments(d.sign() * d.over(-1074, 1024), 0); },
        [&] { return Arguments(d.even(0, 8), 0); }};
    const std::vector<std::function<Arguments()>> errors{[&] { return Arguments(d.even(-7, 28), 0); },
                                                         [&] { return Arguments(d.even(-1.1, 1.1), 0); }};
    // Squares that lie nearly or just in the middle between two doubles.
    const std::vector<Arguments> hard{{0x1p27 + 1, 2}, {0x1p26 + 1, 2}, {0x1p27 + 3, 2},
                                      {0x1.8p0, 40},   {3, 33},         {0.1, 323}};
    return {{"exp",
             our_one<math::exp>,
             exact_one<mpfr_exp>,
             exponents,
             {{709.782712893384, 0}, {-745.13321910194, 0}}},
            {"log", our_one<math::log>, exact_one<mpfr_log>, positive, {}},
            {"log10", our_one<math::log10>, exact_one<mpfr_log10>, positive, {}},
            {"pow", our_two<math::pow>, exact_two<mpfr_pow>, powers, hard},
            {"cbrt", our_one<math::cbrt>, exact_one<mpfr_cbrt>, roots, {}},
            {"erfc", our_one<math::erfc>, exact_one<mpfr_erfc>, errors, {}, 0.515, 10}};
}

// The largest error over so many arguments of each kind, and where it is.
void compare(int count) {
    Draw draw;
    std::vector<Function> functions = circular(draw);
    for (Function& function : exponential(draw)) functions.push_back(std::move(function));
    for (const Function& f : functions) {
        double worst = 0;
        Arguments where;
        Long exact;
        const auto look = [&](const Arguments& a) {
            f.exact(exact, a);
            const double error = error_of(f.ours(a), exact);
            if (!(error <= worst)) worst = error, where = a;
        };
        for (const Arguments& a : f.hard) look(a);
        for (const auto& draw_arguments : f.arguments)
            for (int k = 0; k < count / f.rarer; ++k) look(draw_arguments());
        EXPECT_LT(worst, f.most) << f.name << " of " << where.first << ", " << where.second;
        EXPECT_GT(worst, 0.49) << f.name << ": rounding alone makes half a unit";
        std::printf("%-6s %.4f at %.17g, %.17g\n", f.name, worst, where.first, where.second);
    }
}

TEST(Mathematics, ResultsAreWithinTheErrorsThatTheHeaderStates) {
    compare(3000);
}

TEST(Mathematics, AccuracyLong) {
    compare(100000);
}

}  // namespace
}  // namespace grainreel
