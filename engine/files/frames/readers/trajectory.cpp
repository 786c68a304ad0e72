// Two readers of our own runs: the folder of a run with all that lies in it, and a trajectory.nc alone. The
// other files of moments that a run writes have the format of trajectory.nc, so the second reads them too.

#include <fmt/format.h>
#include <system_error>
#include <utility>

#include "engine/files/frames/frame_archive.hpp"
#include "engine/files/frames/run_archive.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/frames/world.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

class Trajectory final : public FrameArchive {
  public:
    explicit Trajectory(const fs::path& path) : path_(path), reader_(path), world_(world_of(reader_.info())) {
        for (std::size_t place = 0; place < reader_.frames(); ++place) {
            try {
                moments_.push_back(reader_.read_moment(place));
                places_.push_back(place);
            } catch (const DamagedFrame& one) {
                damage_.emplace_back(one.what());
            }
        }
    }

    const fs::path& path() const override { return path_; }
    const World& world() const override { return world_; }
    FrameSupply supply() const override {
        FrameSupply supply;
        supply.orientations = reader_.info().orientation;
        supply.contact_numbers = reader_.info().contact_numbers;
        return supply;
    }
    const std::vector<Frame>& moments() const override { return moments_; }
    Frame grains(std::size_t index) const override { return reader_.read(places_.at(index)); }
    std::size_t place(std::size_t index) const override { return places_.at(index); }
    std::vector<std::string> damage() const override { return damage_; }
    std::vector<std::string> news() const override {
        std::vector<std::string> news = faults_of(reader_, path_.string());
        news.insert(news.end(), damage_.begin(), damage_.end());
        return news;
    }

  private:
    fs::path path_;
    TrajectoryReader reader_;
    World world_;
    std::vector<Frame> moments_;
    std::vector<std::size_t> places_;  // one for each moment: the number of its frame in the file
    std::vector<std::string> damage_;
};

// A trajectory of ours is a classic NetCDF file that names the convention and this program.
bool takes_trajectory(const FileHead& head) {
    const auto says = [&](const char* text) { return head.bytes.find(text) != std::string::npos; };
    return head.bytes.starts_with("CDF") && says("AMBER") && says("grainreel");
}

std::unique_ptr<FrameArchive> open_trajectory(const fs::path& path, const FrameRequest&) {
    return std::make_unique<Trajectory>(path);
}

bool takes_run(const FileHead& head) {
    std::error_code ignored;
    return head.folder && (fs::exists(head.path / "scene.toml", ignored) ||
                           fs::exists(head.path / "trajectory.nc", ignored));
}

std::unique_ptr<FrameArchive> open_run(const fs::path& path, const FrameRequest& request) {
    const fs::path folder = folder_of_run(path);
    const bool for_questions = true;
    auto run = std::make_unique<RunArchive>(
        folder, request.scene_of_run ? request.scene_of_run(folder) : plain_scene_of_run(folder),
        for_questions);
    std::error_code ignored;
    if (fs::exists(folder / "contacts.nc", ignored)) run->read_contacts(true);
    return run;
}

}  // namespace

FrameReader trajectory_reader() {
    return {"trajectory", "the trajectory.nc of a run", takes_trajectory, open_trajectory};
}

FrameReader run_folder_reader() {
    return {"run", "the folder of a run (scene.toml and trajectory.nc)", takes_run, open_run};
}

}  // namespace grainreel
