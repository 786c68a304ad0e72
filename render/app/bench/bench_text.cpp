#include "render/app/bench/bench_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/vector/instructions.hpp"

namespace grainreel {
namespace {

constexpr const char* stage_names[kCosts] = {"neighbours", "contacts",  "walls",
                                             "gather",     "integrate", "other"};
const char* precision_name(Precision precision) {
    return precision == Precision::mixed ? "mixed" : "double";
}

}  // namespace

std::string bench_json(const BenchReport& report) {
    using Json = nlohmann::ordered_json;
    Json phases = Json::array();
    for (const PhaseReport& phase : report.phases) {
        Json stages = Json::object();
        for (int s = 0; s < kCosts; ++s) stages[stage_names[s]] = phase.stage[s];
        Json entry = {{"name", phase.name},
                      {"steps", phase.steps},
                      {"particle_steps_per_s", phase.median()},
                      {"repetitions", phase.particle_steps},
                      {"pairs_listed", phase.listed},
                      {"pairs_touching", phase.touching},
                      {"ns_per_particle_step", stages}};
        if (!phase.of_one_copy.empty())
            entry["particle_steps_per_s_of_one_copy"] = phase.median_of_one_copy();
        phases.push_back(entry);
    }
    const Json all = {{"case", report.name},
                      {"particles", report.particles},
                      {"threads", report.threads},
                      {"precision", precision_name(report.precision)},
                      {"vector_width", vector_instructions()},
                      {"bytes_per_particle", report.bytes_per_particle},
                      {"state_hash", fmt::format("{:016x}", report.state_hash)},
                      {"phases", phases}};
    return all.dump(2);
}

std::string bench_table(const BenchReport& report, bool quick) {
    std::string text = fmt::format(
        "{}: {} grains, {} thread{}, {}, vectors {}, {:.0f} bytes a grain, state "
        "{:016x}\n\n{:<10}{:>8}{:>12}{:>8}",
        report.name, report.particles, report.threads, report.threads == 1 ? "" : "s",
        precision_name(report.precision), vector_instructions(), report.bytes_per_particle, report.state_hash,
        "phase", "steps", "M steps/s", "spread");
    for (const char* name : stage_names) text += fmt::format("{:>12}", name);
    text += fmt::format("{:>10}{:>10}\n", "listed", "touching");
    for (const PhaseReport& phase : report.phases) {
        text += fmt::format("{:<10}{:>8}{:>12.2f}{:>6.0f} %", phase.name, phase.steps, 1e-6 * phase.median(),
                            100 * phase.spread());
        for (const double ns : phase.stage) text += fmt::format("{:>9.1f} ns", ns);
        const double n = static_cast<double>(report.particles);
        text += fmt::format("{:>10.2f}{:>10.2f}\n", static_cast<double>(phase.listed) / n,
                            static_cast<double>(phase.touching) / n);
    }
    for (const PhaseReport& phase : report.phases) {
        if (phase.of_one_copy.empty()) continue;
        text += fmt::format("\n{}: a single copy in the same steps {:.2f} M steps/s, {:.2f} times as many\n",
                            phase.name, 1e-6 * phase.median_of_one_copy(),
                            phase.median_of_one_copy() / phase.median());
    }
    text += "\nM steps/s: million grain-steps a second; ns: of a thread, a step and grain; pairs a grain";
    if (quick)
        text += "\n--quick: a tenth of the steps; the bed is hardly settled, and whole runs are slower";
    return text;
}

}  // namespace grainreel
