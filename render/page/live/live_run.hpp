// Reads the present state of a run from its folder, for the live page. Nothing in the folder is changed, and
// the program that computes the run need not know of it.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "render/page/bed/page_meshes.hpp"
#include "render/page/report.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// What visitors get. Each part is made once and shared by all of them.
struct LiveSnapshot {
    using Bytes = std::shared_ptr<const std::string>;
    Bytes page;     // HTML
    Bytes state;    // JSON: how far the run is, and the numbers of the newest versions of the parts
    Bytes picture;  // JPEG: the film's newest picture; empty without one
    Bytes bed;  // uint32 length of JSON, little-endian; JSON; packed places. empty before there are places
    Bytes measures;  // JSON; empty before there are measures
    Bytes meshes;    // packed as in page_meshes.hpp; they belong to every bed; empty without meshes
};

// Plans a scene; none when this version of the program would not run the scene.
using Planner = std::function<std::optional<PlannedScene>(const FilmedScene&)>;

class LiveRun {
  public:
    LiveRun(std::filesystem::path folder, Planner planner);

    // Reads what is new. To be called on one thread only.
    void refresh();
    // The newest parts. May be called on any thread.
    LiveSnapshot now() const;

    // From the next refresh() on, visitors are told that nothing more will come.
    void say_farewell() { last_ = true; }

    // What the last refresh() found.
    bool is_gone() const { return gone_; }  // its folder is gone
    bool is_over() const { return over_; }  // no program works on it any more
    std::string title() const;

  private:
    struct Wall {
        double simulated = 0;  // s
        std::chrono::steady_clock::time_point at;
    };
    void read_scene_again();
    void read_measures_again();
    void read_bed_again();
    void read_picture_again();
    void make_meshes(const FilmedScene& scene);
    void make_page();
    void make_state();
    double remaining(double time, double end) const;
    std::optional<std::filesystem::path> film() const;

    const std::filesystem::path folder_;
    const Planner planner_;
    bool gone_ = false, over_ = false, last_ = false;
    std::string status_;  // as in run.json; "broken off" for an unfinished run on which no program works
    std::optional<FilmedScene> scene_;
    std::string page_status_;  // status for which the page was made
    std::filesystem::file_time_type scene_time_, trajectory_time_;
    std::uintmax_t measures_size_ = 0, film_size_ = 0;
    std::size_t rows_ = 0;
    double begin_ = 0, time_ = 0;       // s, times of the first and the last row of measures
    std::optional<PageMeshes> meshes_;  // meshes of the scene that was read
    std::int64_t bed_step_ = -1;
    double bed_time_ = 0;
    int pictures_ = 0;
    std::chrono::duration<double> picture_took_{0};
    std::chrono::steady_clock::time_point picture_at_;
    std::deque<Wall> seen_;  // simulated times seen lately, rising, and when they were seen
    mutable std::mutex mutex_;
    LiveSnapshot now_;
};

// The HTML of the live page. Its script (live.js) asks for the rest.
std::string live_page(const FilmedScene& scene, const std::filesystem::path& folder,
                      const std::optional<PlannedScene>& planned);
// A page for the time until the scene of the run can be read. It reloads itself.
std::string waiting_page(const std::string& title);

// The newest picture of a film that is still being written, as a JPEG of at most 960 pixels width. Empty when
// there is no picture yet, or the file is damaged.
std::vector<std::uint8_t> last_picture(const std::filesystem::path& film);

}  // namespace grainreel
