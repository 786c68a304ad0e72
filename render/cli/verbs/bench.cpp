#include "render/cli/verbs/bench.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "engine/bench/bench_run.hpp"
#include "engine/vector/instructions.hpp"
#include "render/cli/report/result.hpp"
#include "render/cli/report/share_watcher.hpp"
#include "render/cli/verbs/bench_render.hpp"

namespace grainreel {
namespace {

constexpr int signal_base = 128;
constexpr const char* stage_names[kCosts] = {"neighbours", "contacts",  "walls",
                                             "gather",     "integrate", "other"};
const char* precision_name(Precision precision) {
    return precision == Precision::mixed ? "mixed" : "double";
}

std::string as_json(const BenchReport& report) {
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

std::string as_table(const BenchReport& report, bool quick) {
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

}  // namespace

int run_bench(const Options& options, Reporter& reporter) {
    if (options.bench == "render") return bench_render(options, reporter);
    const auto& cases = bench_cases();
    const auto found =
        std::find_if(cases.begin(), cases.end(), [&](const BenchCase& c) { return c.name == options.bench; });
    GRAINREEL_CHECK(found != cases.end());
    const BenchOutcome outcome =
        run_bench(*found, options.bench_request, ShareWatcher(reporter, Progress::Stage::timing));
    reporter.clear();
    if (!outcome.complete) {
        reporter.info("stopped; nothing was measured to its end");
        return signal_base + stop_signal();
    }
    print_result(
        (options.json ? as_json(outcome.report) : as_table(outcome.report, options.bench_request.quick)) +
        "\n");
    return 0;
}

}  // namespace grainreel
