// The verb `compare`: runs or reads all its members at the same time, and draws their panels side by side, as
// a film or as one picture.
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <string>
#include <vector>

#include "render/film/compare/comparison.hpp"
#include "render/film/production/film_maker.hpp"
#include "render/film/run/folder_film.hpp"
#include "render/picture/panels/side_by_side.hpp"

namespace grainreel {

class CompareJob final : public FilmJob {
  public:
    CompareJob(const FilmRequest& request, Listener& listener, Comparison all);

  private:
    bool work() override;
    void keep_state() override;
    void side_work_closed() override;
    void conclude() override;
    std::string stopped_text() const override;
    void report_written() override;

    void begin();
    bool next(Shots& frames);
    bool finish(Shots& frames);
    bool draw_film(Shots& frames);
    bool draw_still(Shots& frames);
    // Does `work` for every panel at once, each on a thread of its own, and shows the progress. Returns false
    // if one of them did.
    enum class Stage { packing, pictures };
    using Work = std::function<bool(ComparedMember&, ShotPtr&)>;
    bool for_all(Stage stage, Shots& frames, const Work& work);
    const char* name_of(Stage stage) const;  // name of the stage in run.json
    void show_progress(Stage stage);
    std::function<bool()> go_on() const;

    Comparison all_;
    Stopwatch stage_;
    std::string still_;  // the still's file, once it is written
};

// Does several pieces of work at once, each on a thread of its own. Returns when all have ended; until then
// it calls `watch` now and then. When several works throw, the exception of the first one in order is thrown
// on.
inline void run_together(const std::vector<std::function<void()>>& works,
                         const std::function<void()>& watch) {
    constexpr auto glance = std::chrono::milliseconds(100);
    std::vector<std::future<void>> running;
    for (const auto& work : works) running.push_back(std::async(std::launch::async, work));
    std::exception_ptr problem;
    for (std::future<void>& one : running) {
        while (one.wait_for(glance) != std::future_status::ready) watch();
        try {
            one.get();
        } catch (...) {
            if (!problem) problem = std::current_exception();
        }
    }
    if (problem) std::rethrow_exception(problem);
}

// Makes a drawer whose pictures show several scenes beside each other. film: size, title and background of
// the whole. clock: index of the panel whose time is shown. segments: the film's segment of each picture.
DrawerMaker side_by_side_drawer(const std::vector<Panel>& panels, const Film& film, int raster_threads,
                                gl::Provider provider, std::size_t clock, std::vector<std::size_t> segments);

}  // namespace grainreel
