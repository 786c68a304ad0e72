#include "engine/lab/chart/validation/validation.hpp"

#include <algorithm>

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

}  // namespace grainreel
