#include "engine/lab/chart/accuracy/convergence.hpp"

#include <fmt/format.h>

#include "engine/lab/chart/accuracy/single_contact.hpp"

namespace grainreel {
namespace {

std::vector<Method> laws() {
    const auto verlet = Integrator::velocity_verlet;
    const auto plain = NormalForce::walton_braun, corrected = NormalForce::walton_braun_corrected;
    return {{"slip", verlet, plain, TangentialLaw::incremental_slip},
            {"slip; corrected", verlet, corrected, TangentialLaw::incremental_slip},
            {"spring", verlet, plain, TangentialLaw::linear_spring},
            {"spring; corrected", verlet, corrected, TangentialLaw::linear_spring}};
}

std::vector<double> steps_a_contact(bool quick) {
    if (quick) return {16, 40, 160};
    return {8, 16, 24, 40, 64, 96, 160, 256, 400};
}

constexpr const char* contacts[] = {"impact", "lasting"};

double error_of(const std::string& contact, const Method& law, double steps) {
    return contact == "impact" ? oblique_errors(law, 0.9, steps).velocity : shear_error(law, steps);
}

}  // namespace

std::size_t convergence_pieces(bool quick) {
    return std::size(contacts) * laws().size() * steps_a_contact(quick).size();
}

bool run_convergence(bool quick, ResultTable& table, ChartWork& work) {
    for (const std::string contact : contacts) {
        for (const Method& law : laws()) {
            for (const double steps : steps_a_contact(quick)) {
                if (!work.next(fmt::format("{} contact, {}, {} steps", contact, law.name, steps)))
                    return false;
                if (table.has({contact, law.name, number(steps)})) continue;
                table.add({contact, law.name, number(steps), number(error_of(contact, law, steps))});
            }
        }
    }
    return true;
}

const char* convergence_drawing() {
    return R"(    set output 'convergence.'.form
    set logscale xy
    set multiplot layout 2,1
    laws = "'slip' 'slip; corrected' 'spring' 'spring; corrected'"
    of(contact, law) = sprintf("< awk -F, '$1==\"%s\" && $2==\"%s\" {print $3\",\"$4}' convergence.csv", contact, law)
    set xlabel 'steps in a contact'
    set ylabel 'largest error / speed'
    set xrange [7:450]
    set yrange [1e-6:0.1]
    do for [contact in "impact lasting"] {
        set title contact eq 'impact' ? 'Tangential velocity after an impact at 0 to 85 degrees, e = 0.9' : 'Tangential velocity in a lasting contact that sticks'
        plot for [l in laws] of(contact, l) using 1:2 title l lw 2 ps 0.7, 0.4/x lc 'gray40' dt 2 title 'slope 1', 0.8/x**2 lc 'gray40' dt 3 title 'slope 2'
    }
    unset multiplot
    unset title
    set autoscale
)";
}

}  // namespace grainreel
