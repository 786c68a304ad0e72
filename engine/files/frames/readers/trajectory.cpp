// Two readers of our own runs: the trajectory.nc of a run's folder, with the scene beside it, and a
// trajectory.nc alone. The other files of moments that a run writes have the format of trajectory.nc, so the
// second reads them too. StoredRun (engine/run/stored) reads all that lies in a folder.

#include <fmt/format.h>
#include <optional>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/frames/same_run.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/files/frames/stored_world.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/state/body.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

class Trajectory final : public StateArchive {
  public:
    // path: the file, or the folder of a run with its scene.
    Trajectory(const fs::path& path, const fs::path& file, std::optional<Scene> scene)
        : path_(path), reader_(file), scene_(std::move(scene)), world_(world_of(reader_.info())) {
        if (reader_.frames() == 0 && scene_)
            throw UserError("{}: holds no frame yet; the run was stopped before its first", file.string());
        if (scene_) compare_with_scene();
        for (std::size_t place = 0; place < reader_.frames(); ++place) {
            try {
                moments_.push_back(with_planes(reader_.read_moment(place)));
                places_.push_back(place);
            } catch (const DamagedFrame& one) {
                damage_.emplace_back(one.what());
            }
        }
    }

    const fs::path& path() const override { return path_; }
    const StoredWorld& world() const override { return world_; }
    StateSupply supply() const override {
        StateSupply supply;
        supply.velocities = reader_.info().velocities;
        supply.spins = reader_.info().spins;
        supply.masses = reader_.info().masses;
        supply.orientations = reader_.info().orientation;
        supply.shapes = reader_.info().shapes;
        supply.contact_numbers = reader_.info().contact_numbers;
        return supply;
    }
    const std::vector<State>& moments() const override { return moments_; }
    State grains(std::size_t index) const override { return with_planes(reader_.read(places_.at(index))); }
    std::optional<WorldCell> cell(std::size_t index) const override {
        return scene_ ? world_.cell : world_cell(reader_.cell(places_.at(index)));
    }
    const Scene* scene() const override { return scene_ ? &*scene_ : nullptr; }
    std::size_t place(std::size_t index) const override { return places_.at(index); }
    std::vector<std::string> damage() const override { return damage_; }
    std::vector<std::string> news() const override {
        const std::string name = (scene_ ? path_ / "trajectory.nc" : path_).string();
        std::vector<std::string> news = faults_of(reader_, name);
        if (scene_ && !reader_.info().checksums)
            news.push_back(
                fmt::format("{}: has no checksums, for an earlier version wrote it; damage that leaves "
                            "possible numbers would not show",
                            name));
        news.insert(news.end(), damage_.begin(), damage_.end());
        return news;
    }

  private:
    // What the trajectory says about its world has precedence, because the scene beside it may be of another
    // run. Then this throws UserError.
    void compare_with_scene() {
        const std::string name = (path_ / "trajectory.nc").string();
        check_species(*scene_, world_, name);
        check_meshes(*scene_, world_, name);
        const StoredWorld in_file = std::exchange(world_, world_of(*scene_));
        world_.program_version = in_file.program_version;
        world_.most_grains = in_file.most_grains;
        world_.traffic = in_file.traffic;
        world_.steps_known = in_file.steps_known;
        world_.first_id = in_file.first_id;
    }

    State with_planes(State frame) const {
        if (scene_) add_planes(scene_->walls, frame.time, frame.bodies);
        return frame;
    }

    fs::path path_;
    TrajectoryReader reader_;
    std::optional<Scene> scene_;  // of the folder of a run
    StoredWorld world_;
    std::vector<State> moments_;
    std::vector<std::size_t> places_;  // one for each moment: the number of its frame in the file
    std::vector<std::string> damage_;
};

// A trajectory of ours is a classic NetCDF file that names the convention and this program.
bool takes_trajectory(const FileStart& head) {
    const auto says = [&](const char* text) { return head.bytes.find(text) != std::string::npos; };
    return head.bytes.starts_with("CDF") && says("AMBER") && says("grainreel");
}

std::unique_ptr<StateArchive> open_trajectory(const fs::path& path, const OpenRequest&) {
    return std::make_unique<Trajectory>(path, path, std::nullopt);
}

bool takes_run(const FileStart& head) {
    return head.folder && (is_there(head.path / "scene.toml") || is_there(head.path / "trajectory.nc"));
}

std::unique_ptr<StateArchive> open_run(const fs::path& path, const OpenRequest& request) {
    const fs::path folder = folder_of_run(path);
    return std::make_unique<Trajectory>(
        folder, file_of_run(folder, "trajectory.nc", kWithoutTrajectory),
        request.scene_of_run ? request.scene_of_run(folder) : plain_scene_of_run(folder));
}

}  // namespace

ReadFormat trajectory_reader() {
    return {"trajectory", "the trajectory.nc of a run", takes_trajectory, open_trajectory};
}

ReadFormat run_folder_reader() {
    return {"run", "the folder of a run (scene.toml and trajectory.nc)", takes_run, open_run};
}

}  // namespace grainreel
