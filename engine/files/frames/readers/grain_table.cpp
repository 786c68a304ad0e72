// Reads a table of grains (final.csv) as one frame. It has neither time nor walls. Names, densities and walls
// are those of the scene.toml beside it, if there is one.
#include <algorithm>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/files/outflow_csv.hpp"
#include "engine/grain_table.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

constexpr std::int32_t most_types = 1000;

// The species of a table without a scene: named by their numbers, with the mean diameter of their grains.
std::vector<WorldSpecies> types_of(const State& frame, std::int32_t last) {
    std::vector<WorldSpecies> types(static_cast<std::size_t>(last) + 1);
    for (std::size_t type = 0; type < types.size(); ++type)
        types[type].name = fmt::format("type {}", type + 1);
    std::vector<double> sums(types.size(), 0);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const auto type = static_cast<std::size_t>(frame.species[i]);
        ++types[type].count;
        sums[type] += 2 * frame.radius[i];
    }
    for (std::size_t type = 0; type < types.size(); ++type)
        if (types[type].count > 0) types[type].diameter = sums[type] / static_cast<double>(types[type].count);
    return types;
}

class GrainTable final : public StateArchive {
  public:
    GrainTable(const fs::path& file, const OpenRequest& request)
        : file_(file), frame_(sorted_by_id(read_grain_table(file))) {
        frame_.time = frame_.cycles = kUnknown;
        news_.push_back(fmt::format(
            "{}: holds neither time nor walls; heights are counted from the floor at rest", file_.string()));
        read_scene_beside(request);
        moments_ = {moment_of(frame_)};
        world_.most_grains = frame_.size();
        world_.time_known = false;
    }

    const fs::path& path() const override { return file_; }
    const StoredWorld& world() const override { return world_; }
    StateSupply supply() const override {
        StateSupply supply;
        supply.orientations = !frame_.orientation.empty();
        return supply;
    }
    const std::vector<State>& moments() const override { return moments_; }
    State grains(std::size_t) const override { return frame_; }
    const Scene* scene() const override { return scene_ ? &*scene_ : nullptr; }
    std::vector<std::string> news() const override { return news_; }

  private:
    void read_scene_beside(const OpenRequest& request) {
        const std::int32_t last = *std::max_element(frame_.species.begin(), frame_.species.end());
        const fs::path beside = file_.parent_path();
        if (!is_there(beside / "scene.toml")) {
            if (last >= most_types)
                throw UserError("{}: has grains of type {}; there may be {} types at most", file_.string(),
                                last + 1, most_types);
            world_.species = types_of(frame_, last);
            news_.push_back(
                fmt::format("{}: there is no scene.toml beside it; names, masses and walls are not known",
                            file_.string()));
            return;
        }
        const fs::path folder = beside.empty() ? fs::path(".") : beside;
        scene_ = request.scene_of_run ? request.scene_of_run(folder) : plain_scene_of_run(folder);
        world_ = world_of(*scene_);
        if (static_cast<std::size_t>(last) >= scene_->species.size())
            throw UserError(
                "{}: has grains of type {}, but the scene.toml beside it has {} species; "
                "they are of two runs",
                file_.string(), last + 1, scene_->species.size());
        check_all_are_there();
    }

    // Throws UserError where a final.csv has another number of grains than its scene. It may have one only if
    // grains come or go.
    void check_all_are_there() const {
        const bool traffic = !scene_->feeds.empty() || grains_leave(*scene_);
        const auto grains = static_cast<std::int64_t>(frame_.size());
        if (traffic || file_.filename() != kFinalTable || grains == scene_->grains()) return;
        throw UserError(
            "{}: has {}, but the scene.toml beside it has {}; it was cut off, or they "
            "are of two runs",
            file_.string(), counted(grains, "grain"), scene_->grains());
    }

    fs::path file_;
    State frame_;
    std::vector<State> moments_;
    std::optional<Scene> scene_;
    StoredWorld world_;
    std::vector<std::string> news_;
};

bool takes(const FileStart& head) {
    return !head.folder && begins_grain_table(head.bytes);
}

std::unique_ptr<StateArchive> open(const fs::path& path, const OpenRequest& request) {
    return std::make_unique<GrainTable>(path, request);
}

}  // namespace

ReadFormat grain_table_reader() {
    return {"grain-table", "a table of grains (final.csv)", takes, open};
}

}  // namespace grainreel
