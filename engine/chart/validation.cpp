#include "engine/chart/validation.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {
namespace {

const std::vector<const ValidationPart*>& parts() {
    static const std::vector<const ValidationPart*> all = {&impact_part, &gas_part, &packing_part,
                                                           &silo_part};
    return all;
}

}  // namespace

bool run_validation(const ChartRequest& request, const ChartWatcher& watcher) {
    std::filesystem::create_directories(request.folder);
    std::size_t pieces = 0;
    for (const ValidationPart* part : parts()) pieces += part->pieces(request.quick);
    ChartWork work(watcher, pieces);
    return std::all_of(parts().begin(), parts().end(),
                       [&](const ValidationPart* part) { return part->run(request, work); });
}

SeedMean mean_of(const std::vector<double>& values) {
    const double count = static_cast<double>(values.size());
    double mean = 0, squares = 0;
    for (const double v : values) mean += v / count;
    for (const double v : values) squares += (v - mean) * (v - mean);
    return {mean, std::sqrt(squares / std::max(1.0, count - 1) / count)};
}

}  // namespace grainreel
