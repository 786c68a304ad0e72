#include "engine/lab/chart/accuracy/accuracy.hpp"

#include <fmt/format.h>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/lab/chart/accuracy/single_contact.hpp"
#include "engine/lab/chart/accuracy/spins.hpp"
#include "engine/lab/chart/chart.hpp"
#include "engine/lab/chart/gas.hpp"
#include "engine/lab/chart/small_bed.hpp"

namespace grainreel {

namespace {

// accuracy_drawing() repeats these names. Their order gives the colours, here and in gas_drift_drawing().
std::vector<Method> methods() {
    using I = Integrator;
    const auto slip = TangentialLaw::incremental_slip;
    return {
        {"velocity Verlet", I::velocity_verlet, NormalForce::walton_braun, slip},
        {"with corrections", I::velocity_verlet, NormalForce::walton_braun_corrected, slip},
        {"mixed precision", I::velocity_verlet, NormalForce::walton_braun_corrected, slip, Precision::mixed},
        {"leapfrog", I::leapfrog, NormalForce::walton_braun, slip},
        {"position Verlet", I::position_verlet, NormalForce::walton_braun, slip},
        {"Forest-Ruth", I::forest_ruth, NormalForce::walton_braun, slip},
        {"Gear", I::gear, NormalForce::walton_braun, slip},
        {"spring-dashpot", I::velocity_verlet, NormalForce::spring_dashpot, TangentialLaw::linear_spring},
        {"Hertz-Mindlin", I::velocity_verlet, NormalForce::hertz, TangentialLaw::mindlin}};
}

// Numbers of force evaluations in a contact. The number of steps of each method follows from them, so that
// methods are compared at equal cost.
std::vector<double> force_counts(bool quick) {
    if (quick) return {8, 12, 20, 40};
    return {6, 8, 10, 12, 16, 20, 28, 40, 80, 160};
}
std::vector<double> restitutions(bool quick) {
    if (quick) return {0.3, 0.9};
    return {0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98};
}

// Settings that change one factor at a time from the default: step, corrections, precision, stiffness, arms,
// law. The reference must stand first: bed_differences() compares with the first row of the table.
std::vector<BedSetting> bed_settings(bool quick) {
    const auto step = [](double share) {
        return fmt::format("run.step={:.10g}", share * default_bed_step());
    };
    std::vector<BedSetting> all = {{"reference", {step(0.125)}},
                                   {"default", {}},
                                   {"no corrections", {"run.contact_corrections=false"}},
                                   {"step x 2", {step(2)}}};
    if (quick) return all;
    for (const BedSetting& more : std::vector<BedSetting>{{"step x 0.5", {step(0.5)}},
                                                          {"mixed precision", {"run.precision=mixed"}},
                                                          {"overlap 0.2 %", {"run.overlap=0.002"}},
                                                          {"overlap 2 %", {"run.overlap=0.02"}},
                                                          {"overlap 5 %", {"run.overlap=0.05"}},
                                                          {"arms of the seed", {"contact.arms=radius"}},
                                                          {"spring-dashpot", {"contact.law=spring-dashpot"}},
                                                          {"Hertz-Mindlin", {"contact.law=hertz"}}})
        all.push_back(more);
    return all;
}

// Adds the rows that are still missing for one method, restitution and number of forces.
void add_contact_rows(const Method& method, double e, double forces, bool quick, double cost,
                      ResultTable& table) {
    const double steps = forces / method.forces_a_step();
    const auto missing = [&](const char* error) {
        return !table.has({method.name, error, number(e), number(forces)});
    };
    const auto add = [&](const char* error, double value) {
        if (missing(error))
            table.add({method.name, error, number(e), number(forces), number(cost * forces), number(value)});
    };
    if (missing("restitution") || missing("contact time")) {
        const NormalErrors normal = normal_errors(method, e, steps, quick ? 40 : 200);
        add("restitution", normal.restitution);
        add("contact time", normal.contact_time);
    }
    if (missing("velocity") || missing("spin")) {
        const ObliqueErrors oblique = oblique_errors(method, e, steps);
        add("velocity", oblique.velocity);
        add("spin", oblique.spin);
    }
    if (e == 0.9 && missing("energy drift")) add("energy drift", bounce_drift(method, steps, 1000));
}

// Whether the table has the row that add_contact_rows() adds last: "spin", or "energy drift" where e is 0.9.
bool all_there(const Method& method, double e, double forces, const ResultTable& table) {
    return table.has({method.name, "spin", number(e), number(forces)}) &&
           (e != 0.9 || table.has({method.name, "energy drift", number(e), number(forces)}));
}

// The cost (ns) of one force, as the table has it already, so that one measurement holds for all rows of a
// method; else 0.
double noted_cost(const Method& method, const ResultTable& table) {
    for (const auto& row : table.rows())
        if (row.at(0) == method.name) return value_in(row, 4) / value_in(row, 3);
    return 0;
}

bool run_contacts(bool quick, ResultTable& table, ChartWork& work) {
    for (const Method& method : methods()) {
        double cost = noted_cost(method, table);
        for (const double e : restitutions(quick)) {
            for (const double forces : force_counts(quick)) {
                if (!work.next(fmt::format("{}, e = {}, {} forces a contact", method.name, e, forces)))
                    return false;
                if (all_there(method, e, forces, table)) continue;
                if (cost == 0) cost = cost_of_a_contact(method);
                add_contact_rows(method, e, forces, quick, cost, table);
            }
        }
    }
    return true;
}

bool run_beds(bool quick, ResultTable& table, ChartWork& work) {
    for (int seed = 1; seed <= (quick ? 2 : 5); ++seed) {
        for (const BedSetting& setting : bed_settings(quick)) {
            if (!work.next(fmt::format("bed, {}, seed {}", setting.name, seed))) return false;
            if (table.has({setting.name, number(seed)})) continue;
            try {
                const auto r = run_bed(setting, static_cast<std::uint64_t>(seed), quick ? 0.5 : 2.0,
                                       [&] { return work.goes_on(); });
                if (!r) return false;
                table.add({setting.name, number(seed), number(r->height), number(r->temperature),
                           number(r->contacts), number(r->mixing), number(r->cost)});
            } catch (const RunError&) {  // a run that the health check stopped is a result too
                table.add({setting.name, number(seed), "nan", "nan", "nan", "nan", "nan"});
            }
        }
    }
    return true;
}

std::string differences_table(const ResultTable& beds) {
    std::vector<BedRow> rows;
    for (const auto& cells : beds.rows()) {
        const auto value = [&](std::size_t k) { return value_in(cells, k); };
        rows.push_back({cells.at(0), {value(2), value(3), value(4), value(5), value(6)}});
    }
    std::string text =
        "setting,seeds,height_percent,error,temperature_percent,error,contacts_percent,error,mixing_percent,"
        "error,cost_ratio\n";
    for (const BedDifference& d : bed_differences(rows))
        text += fmt::format("{},{},{:.3f},{:.3f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{:.3f}\n",
                            d.setting, d.seeds, d.height, d.height_error, d.temperature, d.temperature_error,
                            d.contacts, d.contacts_error, d.mixing, d.mixing_error, d.cost);
    return text;
}

}  // namespace

bool run_accuracy(const ChartRequest& request, const ChartWatcher& watcher) {
    std::filesystem::create_directories(request.folder);
    ResultTable contacts(request.folder / "contacts.csv", "method,error,e,forces,ns,value", 4);
    ResultTable beds(request.folder / "bed.csv",
                     "setting,seed,height_m,temperature_m2s2,contacts,mixing,cost_ns", 2);
    ResultTable convergence(request.folder / "convergence.csv", "contact,law,steps,error", 3);
    ResultTable gases(request.folder / "gas.csv", "method,e,seed,contacts,steps,gained,lost", 4);
    ResultTable spins(request.folder / "spins.csv", "law,e,degrees,steps,velocity,spin,normal,formula", 3);
    const std::size_t pieces =
        convergence_pieces(request.quick) + gas_drift_pieces(request.quick) + spin_pieces(request.quick) +
        methods().size() * restitutions(request.quick).size() * force_counts(request.quick).size() +
        bed_settings(request.quick).size() * (request.quick ? 2 : 5);
    ChartWork work(watcher, pieces);
    if (!run_spins(request.quick, spins, work) || !run_contacts(request.quick, contacts, work) ||
        !run_convergence(request.quick, convergence, work) || !run_gas_drift(request.quick, gases, work) ||
        !run_beds(request.quick, beds, work))
        return false;
    replace_file(request.folder / "differences.csv", differences_table(beds));
    return true;
}

std::string accuracy_drawing() {
    return R"(# Draws contacts.csv, convergence.csv, spins.csv, gas.csv and bed.csv, and the other engines of peers.csv (made by
# tests/peers/impacts.sh) where that lies beside them: gnuplot accuracy.gp
set datafile separator ','
set style data linespoints
set grid
set key outside right top maxcols 1 width -4 font ',12'
set logscale xy
set format y "10^{%L}"
methods = "'velocity Verlet' 'with corrections' 'mixed precision' 'leapfrog' 'position Verlet' 'Forest-Ruth' 'Gear' 'spring-dashpot' 'Hertz-Mindlin'"
pick(method, error, e) = sprintf("< awk -F, '$1==\"%s\" && $2==\"%s\" && $3==%s {print $4\",\"$5\",\"$6}' contacts.csv", method, error, e)
peer(e) = sprintf("< awk -F, '$1==\"LAMMPS\" && $3==%s {print $4\",\"$5\",\"$6}' peers.csv 2>/dev/null", e)

do for [form in "svg png"] {
    if (form eq "svg") { set terminal svg size 900,740 font 'DejaVu Sans,14' background 'white' } else { set terminal pngcairo size 1350,1110 font 'DejaVu Sans,18' }
    set xrange [*:*]
    set output 'oblique.'.form
    set xlabel 'cost of a contact, ns of one thread'
    set multiplot layout 2,1
    set ylabel 'largest error / speed'
    set title 'Tangential velocity after an impact at 0 to 85 degrees, e = 0.9'
    plot for [m in methods] pick(m, 'velocity', '0.9') using 2:3 title m lw 2
    set title 'Energy drift after 1,000 elastic bounces'
    set ylabel '|dE| / E'
    plot for [m in methods] pick(m, 'energy drift', '0.9') using 2:($3 > 1e-15 ? $3 : 1e-15) title m lw 2
    unset multiplot
    unset title
)" + std::string(convergence_drawing()) +
           spins_drawing() + speed_drawing() + gas_drift_drawing() +
           R"(    set output 'bed.'.form
    unset logscale
    set format xy '%g'
    set offsets 0, 0, 0.5, 0.5
    set yrange [] reverse
    set multiplot layout 2,2 title 'A vibrated bed of 1,000 grains against its reference (an eighth of the default step)'
    unset key
    unset ylabel
    set xtics font ',10'
    do for [k=1:4] {
        set xlabel word('height temperature contacts mixing', k).', difference in %'
        plot 'differences.csv' every ::1 using (column(2*k+1)):0:(column(2*k+2)):ytic(1) with xerrorbars pt 7 lw 2 notitle
    }
    unset multiplot
    unset offsets
    set yrange [] noreverse
    set ytics auto
    set xtics font ',14'
    set ylabel
    set format x '%g'
    set key outside right top maxcols 1 width -4 font ',12'
    set logscale xy
    set format y "10^{%L}"
}
)";
}

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
