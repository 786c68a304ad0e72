#include "engine/questions/discharge.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/outflow_csv.hpp"
#include "engine/measure/flow/beverloo.hpp"
#include "engine/run/stored/stored_run.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {
namespace {

constexpr std::size_t least_times = 50;

struct Series {
    std::vector<double> times, gone;
};

std::optional<Series> series_in(const std::filesystem::path& folder, const Scene& scene) {
    if (const auto sums = OutflowSums::read(folder / "outflow.csv", scene))
        return Series{sums->times(), sums->masses()};
    const auto table = read_measures(folder / "measures.csv");
    if (table == nullptr || !table->find("outflow_kg") || !table->find("time_s")) return std::nullopt;
    return Series{table->all("time_s"), table->all("outflow_kg")};
}

// The half of the interval has two digits, and the rate as many decimals.
std::string rate_text(const Estimate& rate) {
    if (!std::isfinite(rate.half_width))
        return fmt::format("{:.4g} kg/s (no interval: {})", rate.value, rate.why);
    if (!(rate.half_width > 1e-12)) return fmt::format("{:.4g} kg/s", rate.value);
    const int decimals = std::max(0, 1 - static_cast<int>(std::floor(math::log10(rate.half_width))));
    return fmt::format("{:.{}f} ± {:.{}f} kg/s", rate.value, decimals, rate.half_width, decimals);
}

// What the answer says where it has no time of emptying; empty where it has one.
std::string why_not_emptied(const Discharge& flow, const Scene& scene) {
    if (flow.emptied) return "";
    if (!scene.feeds.empty()) return "emptied: none, because a feed brings more";
    if (flow.would_empty) return "emptied: none, the run ended before";
    return fmt::format("emptied: none, {:.2g} % of the mass stay inside",
                       100 * (1 - flow.mass / total_mass(scene)));
}

}  // namespace

std::optional<Discharge> discharge_of(const std::vector<double>& times, const std::vector<double>& gone,
                                      double all) {
    if (times.size() < least_times || !(gone.back() > 0)) return std::nullopt;
    Discharge flow;
    flow.mass = gone.back();
    const std::size_t begin = first_with(gone, 0.1 * flow.mass), end = first_with(gone, 0.7 * flow.mass);
    if (end < begin + 2 || !(times[end] > times[begin])) return std::nullopt;
    flow.from = times[begin], flow.to = times[end];
    // Grains leave in bursts, so the mass that is out is looked at in equal times.
    constexpr std::size_t looks = 2 * kMostBatches;
    std::vector<double> moments, masses;
    for (std::size_t i = 0; i <= looks; ++i) {
        moments.push_back(flow.from +
                          (flow.to - flow.from) * static_cast<double>(i) / static_cast<double>(looks));
        const auto after = std::upper_bound(times.begin(), times.end(), moments.back());
        masses.push_back(
            gone[static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, after - times.begin()) - 1)]);
    }
    flow.rate = slope_estimate(moments, masses);
    if (!(all > 0)) return flow;
    constexpr double empty = 0.99;
    if (const std::size_t last = first_with(gone, empty * all); last < times.size())
        flow.emptied = times[last];
    else if (flow.rate.value > 0)
        flow.would_empty = flow.to + (all - gone[end]) / flow.rate.value;
    return flow;
}

std::optional<Discharge> discharge_in(const std::filesystem::path& folder, const Scene& scene) {
    if (!grains_leave(scene) && !scene.container.tray) return std::nullopt;
    const auto series = series_in(folder, scene);
    if (!series || series->times.empty()) return std::nullopt;
    const bool more_comes = !scene.feeds.empty();
    auto flow = discharge_of(series->times, series->gone, more_comes ? 0 : total_mass(scene));
    // What lies still beside an outlet does not come at any rate.
    if (flow && flow->would_empty && *flow->would_empty < scene.run.duration) flow->would_empty.reset();
    return flow;
}

std::vector<std::string> discharge_lines(const std::filesystem::path& folder, const Scene& scene) {
    const std::optional<Discharge> flow = discharge_in(folder, scene);
    if (!flow) return {};
    std::string line =
        fmt::format("outflow: {} from {:.4g} s to {:.4g} s", rate_text(flow->rate), flow->from, flow->to);
    if (flow->emptied)
        line += fmt::format("; empty at {:.4g} s", *flow->emptied);
    else if (flow->would_empty)
        line += fmt::format("; at this rate it would be empty at {:.4g} s", *flow->would_empty);
    else if (scene.feeds.empty())
        line += fmt::format("; {:.2g} % of the mass stay inside", 100 * (1 - flow->mass / total_mass(scene)));
    std::vector<std::string> lines{line};
    if (const auto expected = beverloo_rate(scene))
        lines.push_back(fmt::format("Beverloo's law expects {:.4g} kg/s: {}, ρ = {} of the grains' density",
                                    *expected, beverloo_words(scene), kFlowingFraction));
    return lines;
}

Answer discharge_answer(const StoredRun& run) {
    const Scene& scene = run.known_scene();
    const std::optional<Discharge> flow = discharge_in(run.path(), scene);
    if (!flow)
        throw UserError("{}: fewer than {} grains have left, or none can; ask a run with an outlet",
                        run.path().string(), least_times);
    const auto known = [](double value) { return std::isfinite(value) ? AnswerCell(value) : AnswerCell(); };
    const auto maybe = [](const std::optional<double>& value) {
        return value ? AnswerCell(*value) : AnswerCell();
    };
    AnswerTable table{
        "discharge",
        "Outflow",
        {{"rate", Dimension::mass_flow, "from 10 % to 70 % of what flowed out"},
         {"half_width", Dimension::mass_flow, "of its interval of 95 %"},
         {"from", Dimension::time, ""},
         {"to", Dimension::time, ""},
         {"mass", Dimension::mass, "that flowed out"},
         {"emptied", Dimension::time, "less than 1 % left"},
         {"would_empty", Dimension::time, "at this rate"},
         {"beverloo", Dimension::mass_flow, "the rate that Beverloo's law expects"}},
        {{known(flow->rate.value), known(flow->rate.half_width), flow->from, flow->to, flow->mass,
          maybe(flow->emptied), maybe(flow->would_empty), maybe(beverloo_rate(scene))}}};
    Answer answer{{std::move(table)}, {}};
    if (!flow->rate.why.empty()) answer.notes.push_back("no interval of the rate, " + flow->rate.why);
    if (const std::string why = why_not_emptied(*flow, scene); !why.empty()) answer.notes.push_back(why);
    const std::string unknown = why_no_beverloo(scene);
    answer.notes.push_back(
        unknown.empty()
            ? fmt::format("Beverloo's law: {}, ρ = {} of the grains' density (Beverloo, Leniger, van "
                          "de Velde 1961; slots: Nedderman 1992)",
                          beverloo_words(scene), kFlowingFraction)
            : "Beverloo's law: expects no rate here, " + unknown);
    return answer;
}

}  // namespace grainreel
