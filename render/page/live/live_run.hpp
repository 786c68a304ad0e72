// A run as it is now, read from its folder: what the live page shows. Nothing in the folder is changed, and
// the program that runs need not know.
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

// What visitors get; each part is made once and shared by all of them.
struct LiveSnapshot {
    using Bytes = std::shared_ptr<const std::string>;
    Bytes page;      // HTML
    Bytes state;     // JSON: how far the run is, and which versions of the other parts there are
    Bytes picture;   // JPEG: the film's newest; empty without one
    Bytes bed;       // uint32 length of JSON, little-endian; JSON; packed places. Empty before there are any
    Bytes measures;  // JSON; empty as above
    Bytes meshes;    // as page_meshes.hpp has them, packed; they belong to every bed. Empty without any
};

using Planner = std::function<std::optional<PlannedScene>(const FilmedScene&)>;

class LiveRun {
  public:
    LiveRun(std::filesystem::path folder, Planner planner);

    // Reads what is new. On one thread.
    void refresh();
    // On any thread.
    LiveSnapshot now() const;

    // From the next refresh() on visitors are told that there is nothing more to come.
    void say_farewell() { last_ = true; }

    // As the last refresh() found it.
    bool is_gone() const { return gone_; }  // its folder is
    bool is_over() const { return over_; }  // nobody works on it any more
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
    std::string status_;  // as run.json has it; "broken off" where nobody works on it and it is not finished
    std::optional<FilmedScene> scene_;
    std::string page_status_;  // that the page was made for
    std::filesystem::file_time_type scene_time_, trajectory_time_;
    std::uintmax_t measures_size_ = 0, film_size_ = 0;
    std::size_t rows_ = 0;
    double begin_ = 0, time_ = 0;       // s, of the first row of measures and the last
    std::optional<PageMeshes> meshes_;  // of the scene that was read
    std::int64_t bed_step_ = -1;
    double bed_time_ = 0;
    int pictures_ = 0;
    std::chrono::duration<double> picture_took_{0};
    std::chrono::steady_clock::time_point picture_at_;
    std::deque<Wall> seen_;  // lately; by rising time
    mutable std::mutex mutex_;
    LiveSnapshot now_;
};

// The live page's HTML. Its scripts (live.js) ask for the rest.
std::string live_page(const FilmedScene& scene, const std::filesystem::path& folder,
                      const std::optional<PlannedScene>& planned);
// A page for the time until the scene of the run can be read. It asks again by itself.
std::string waiting_page(const std::string& title);

// The newest picture of a film that still grows: a JPEG, 960 pixels wide at most. Empty where there is none
// yet, or the file is damaged.
std::vector<std::uint8_t> last_picture(const std::filesystem::path& film);

}  // namespace grainreel
