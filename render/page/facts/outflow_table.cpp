// The table of how fast grains flow out of hoppers, beside what Beverloo's law expects.
#include "render/page/facts/run_names.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/mathematics.hpp"
#include "engine/measure/flow/beverloo.hpp"
#include "engine/questions/discharge.hpp"
#include "engine/scene/text/units.hpp"
#include "render/page/embed.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

struct Flow {
    std::string name;
    Discharge measured;
    std::optional<double> law;  // kg/s
};

// "87.2 ± 3.4": the interval has two digits, and the rate as many decimals.
std::string rate_text(const Estimate& rate, double size) {
    const double half = rate.half_width / size;
    if (!(half > 1e-9)) return fmt::format("{:.3g}", rate.value / size);
    const int decimals = std::max(0, 1 - static_cast<int>(std::floor(math::log10(half))));
    return fmt::format("{:.{}f} ± {:.{}f}", rate.value / size, decimals, half, decimals);
}

std::string cell(const std::optional<double>& value, const char* form) {
    return fmt::format("<td>{}</td>", value ? fmt::format(fmt::runtime(form), *value) : "–");
}

std::string row_of(const Flow& flow, double size, bool named) {
    std::optional<double> law = flow.law, ratio;
    if (law) ratio = flow.measured.rate.value / *law, law = *law / size;
    return fmt::format("<tr>{}<td>{}</td>{}{}{}</tr>\n",
                       named ? fmt::format("<th scope=\"row\">{}</th>", html_text(flow.name)) : "",
                       rate_text(flow.measured.rate, size), cell(law, "{:.3g}"), cell(ratio, "{:.2f}"),
                       cell(flow.measured.emptied, "{:.3g}"));
}

std::vector<Flow> flows_of(const std::vector<RunToName>& runs) {
    std::vector<Flow> flows;
    for (const RunToName& run : runs)
        if (const auto measured = discharge_in(run.folder, run.scene))
            flows.push_back({run.given, *measured, beverloo_rate(run.scene)});
    return flows;
}

}  // namespace

std::string outflow_html(const std::vector<RunToName>& runs, const PageWords& say) {
    const std::vector<Flow> flows = flows_of(runs);
    if (flows.empty()) return "";
    double largest = 0;
    for (const Flow& flow : flows) largest = std::max(largest, flow.measured.rate.value);
    const std::string unit = fitting_unit(largest, Dimension::mass_flow);
    const double size = unit_size(unit, Dimension::mass_flow);
    const bool named = runs.size() > 1;
    std::string heads = named ? fmt::format("<th scope=\"col\">{}</th>", html_text(say("run"))) : "", rows;
    for (const std::string& head : {say("measured, {1}", {unit}), say("Beverloo’s law, {1}", {unit}),
                                    say("measured / law"), say("empty at, s")})
        heads += fmt::format("<th scope=\"col\">{}</th>", html_text(head));
    for (const Flow& flow : flows) rows += row_of(flow, size, named);
    return fmt::format(
        "<section aria-labelledby=\"outflow\">\n<h2 id=\"outflow\">{0}</h2>\n<p>{1}</p>\n"
        "<div class=\"table\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\">\n<table>\n"
        "<thead><tr>{2}</tr></thead>\n<tbody>\n{3}</tbody>\n</table>\n</div>\n</section>\n",
        html_text(say("How fast the grains flow out")),
        html_text(say(
            "The rate between the moments at which 10 % and 70 % of all that flows out were out, with its "
            "interval of 95 %. Beverloo’s law knows the outlet and the grains alone; friction and slanted "
            "walls change the rate by 20 % and more.")),
        heads, rows);
}

}  // namespace grainreel
