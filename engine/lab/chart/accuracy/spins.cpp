#include "engine/lab/chart/accuracy/spins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/lab/chart/accuracy/planned_impact.hpp"

namespace grainreel {
namespace {

constexpr double kFriction = 0.5;
constexpr double kFiner = 100;  // how many times shorter the steps of the reference are

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

// Whether a ball slides all the time, whatever the law: with a margin of a tenth, because the condition is
// that of a linear spring.
bool slides(double restitution, double degrees) {
    const double angle = radians(degrees);
    return math::sin(angle) > 1.1 * kFriction * 3.5 * (1 + restitution) * math::cos(angle);
}

std::vector<double> restitutions() {
    return {0.9, 0.5};
}
std::vector<double> angles(bool quick) {
    std::vector<double> degrees;
    for (int d = quick ? 20 : 5; d <= 80; d += quick ? 20 : 5) degrees.push_back(d);
    return degrees;
}

}  // namespace

const std::vector<PlannedLaw>& planned_laws() {
    static const std::vector<PlannedLaw> all = {
        {"Walton-Braun", ""},
        {"Walton-Braun by speed", "restitution_speed = 0.3\n"},
        {"Walton-Braun; linear spring", "friction_law = \"linear-spring\"\n"},
        {"spring-dashpot; slip", "law = \"spring-dashpot\"\nfriction_law = \"incremental-slip\"\n"},
        {"spring-dashpot", "law = \"spring-dashpot\"\n"},
        {"Hertz-Mindlin", "law = \"hertz\"\n"}};
    return all;
}

PlannedErrors planned_errors(const PlannedLaw& law, double restitution, double degrees, int phases) {
    ImpactScene impact;
    impact.restitution = restitution;
    impact.friction = kFriction;
    impact.wall = true;
    impact.law = law.lines;
    const Plan plan = plan_of(impact);
    const double angle = radians(degrees), step = plan.clock.step;
    const Impact fine = make_impact(impact, plan, step / kFiner, angle, 0.5);
    const double down = impact.speed * math::cos(angle), rebound = -fine.velocity[0].x() / down;
    PlannedErrors errors;
    errors.steps = plan.wall[0].contact_time / step;
    errors.formula = std::numeric_limits<double>::quiet_NaN();
    if (slides(restitution, degrees))
        errors.formula = std::abs(fine.velocity[0].y() / impact.speed -
                                  (math::sin(angle) - kFriction * (1 + rebound) * math::cos(angle)));
    for (int phase = 0; phase < phases; ++phase) {
        const Impact after = make_impact(impact, plan, step, angle, (phase + 0.5) / phases);
        const Vec3 off = after.velocity[0] - fine.velocity[0];
        errors.velocity = std::max(errors.velocity, std::abs(off.y()) / impact.speed);
        errors.normal = std::max(errors.normal, std::abs(off.x()) / down);
        errors.spin = std::max(errors.spin, std::abs(after.spin[0].z() / fine.spin[0].z() - 1));
    }
    return errors;
}

std::size_t spin_pieces(bool quick) {
    return planned_laws().size() * restitutions().size() * angles(quick).size();
}

bool run_spins(bool quick, ResultTable& table, ChartWork& work) {
    for (const PlannedLaw& law : planned_laws()) {
        for (const double e : restitutions()) {
            for (const double degrees : angles(quick)) {
                if (!work.next(fmt::format("{}, e = {}, {} degrees", law.name, e, degrees))) return false;
                if (table.has({law.name, number(e), number(degrees)})) continue;
                const PlannedErrors is = planned_errors(law, e, degrees, quick ? 4 : 16);
                table.add({law.name, number(e), number(degrees), number(is.steps), number(is.velocity),
                           number(is.spin), number(is.normal), number(is.formula)});
            }
        }
    }
    return true;
}

const char* spins_drawing() {
    return R"(    set output 'spins.'.form
    set logscale y
    unset logscale x
    set format x '%g'
    set multiplot layout 2,1
    laws = "'Walton-Braun' 'Walton-Braun by speed' 'Walton-Braun; linear spring' 'spring-dashpot; slip' 'spring-dashpot' 'Hertz-Mindlin'"
    at(law, e) = sprintf("< awk -F, '$1==\"%s\" && $2==%s {print $3\",\"$5\",\"$6}' spins.csv", law, e)
    set xlabel 'angle of the impact from the normal, degrees'
    set xrange [0:85]
    set xtics 10
    do for [k=2:3] {
        set ylabel k==2 ? 'largest error / speed' : 'largest error / spin'
        set title k==2 ? "Tangential velocity after an impact, at the plan's step : e = 0.9 (lines), 0.5 (dashes) " : "Spin after an impact, at the plan's step"
        set yrange [1e-5:(k==2 ? 0.1 : 1)]
        plot for [m=1:6] at(word(laws, m), '0.9') using 1:k title word(laws, m) lw 2 lc m pt m, \
             for [m=1:6] at(word(laws, m), '0.5') using 1:k notitle lw 1.5 lc m pt m ps 0.6 dt 2, \
             0.0008 lc 'gray30' lw 2 dt 3 title 'error of e, standard'
    }
    unset multiplot
    unset title
    set xtics autofreq
    set autoscale
    set logscale xy
)";
}

}  // namespace grainreel
