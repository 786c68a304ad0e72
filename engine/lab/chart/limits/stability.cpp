#include "engine/lab/chart/limits/stability.hpp"

#include "engine/lab/chart/chart.hpp"

namespace grainreel {

std::vector<Experiment> stability_experiments() {
    std::vector<Experiment> all;
    for (const auto& family :
         {step_experiments(), speed_experiments(), restitution_experiments(), friction_experiments(),
          path_experiments(), detachment_experiments(), softness_experiments(), drive_experiments(),
          bed_experiments(), number_experiments()})
        all.insert(all.end(), family.begin(), family.end());
    return all;
}

namespace {

std::string cell(double value) {
    return std::isnan(value) ? "nan" : number(value);
}

void add_rows(const Experiment& experiment, const Finding& finding, ResultTable& limits,
              ResultTable& curves) {
    const std::string& name = experiment.name;
    for (const CurvePoint& point : finding.curve)
        if (!curves.has({name, cell(point.x)}))
            curves.add({name, cell(point.x), cell(point.value), cell(point.theory)});
    const bool compares = finding.theory != 0;
    limits.add({name, experiment.varied, cell(finding.theory), cell(finding.measured),
                cell(compares ? finding.measured / finding.theory : unknown), cell(finding.usual),
                experiment.failure == Failure::loud ? "loud" : "silent", experiment.guard});
}

}  // namespace

bool run_stability(const ChartRequest& request, const ChartWatcher& watcher) {
    std::filesystem::create_directories(request.folder);
    ResultTable limits(request.folder / "limits.csv",
                       "experiment,varied,theory,measured,ratio,default,kind,guard", 1);
    ResultTable curves(request.folder / "curves.csv", "experiment,x,value,theory", 2);
    const std::vector<Experiment> all = stability_experiments();
    ChartWork work(watcher, all.size());
    for (const Experiment& experiment : all) {
        if (!work.next(experiment.name)) return false;
        if (limits.has({experiment.name})) continue;
        add_rows(experiment, experiment.run(request.quick), limits, curves);
    }
    return true;
}

}  // namespace grainreel
