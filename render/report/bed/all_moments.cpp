#include "render/report/bed/all_moments.hpp"

#include "engine/state/wall_motion.hpp"
#include "render/run/frames/same_run.hpp"
#include "render/run/run_files.hpp"

namespace grainreel {

namespace fs = std::filesystem;

bool AllMoments::has_more(const fs::path& folder) {
    std::error_code ignored;
    return fs::exists(folder / kFilmMoments, ignored);
}

AllMoments::AllMoments(const RecordedRun& run) : run_(run), film_(run.folder() / kFilmMoments) {
    const std::string name = (run.folder() / kFilmMoments).string();
    const std::vector<Frame>& kept = run.moments();
    if (film_.frames() > 0) check_grains(run.scene(), film_.info(), film_.read(0), name);
    std::size_t next = 0;  // of the trajectory
    const auto take_until = [&](std::int64_t step) {
        for (; next < kept.size() && kept[next].step <= step; ++next) {
            moments_.push_back(kept[next]);
            places_.push_back({false, next});
        }
    };
    for (std::size_t index = 0; index < film_.frames(); ++index) {
        Frame moment = film_.read_moment(index);
        take_until(moment.step);
        if (!moments_.empty() && moments_.back().step >= moment.step) continue;  // it is there already
        add_planes(run.scene().walls, moment.time, moment.bodies);
        check_drive(run.scene(), run.clock(), moment, name);
        moments_.push_back(std::move(moment));
        places_.push_back({true, index});
    }
    take_until(kept.back().step);
}

Frame AllMoments::grains(std::size_t index) const {
    const Place& place = places_.at(index);
    if (!place.of_film) return run_.grains(place.index);
    Frame frame = film_.read(place.index);
    add_planes(run_.scene().walls, frame.time, frame.bodies);
    return frame;
}

Frame AllMoments::frame(std::size_t index) const {
    const Place& place = places_.at(index);
    return place.of_film ? grains(index) : run_.frame(place.index);
}

}  // namespace grainreel
