// One run of the verb `compare`, from the accepted scenes to the closed files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/film/compare/comparison.hpp"
#include "render/film/run/folder_film.hpp"

namespace grainreel {

class CompareRun final : public FilmRun {
  public:
    CompareRun(const FilmRequest& request, RunListener& listener, Comparison all);

  private:
    bool work() override;
    void keep_state() override;
    void side_work_closed() override;
    void conclude() override;
    std::string stopped_text() const override;
    void report_written() override;

    void begin();
    bool next(Frames& frames);
    bool finish(Frames& frames);
    bool draw_film(Frames& frames);
    bool draw_still(Frames& frames);
    // Does the same for every panel at once, and shows how far they are; false when asked to stop.
    enum class Stage { packing, pictures };
    using Work = std::function<bool(ComparedMember&, FramePtr&)>;
    bool for_all(Stage stage, Frames& frames, const Work& work);
    const char* name_of(Stage stage) const;  // in run.json
    void show_progress(Stage stage);
    std::function<bool()> go_on() const;

    Comparison all_;
    Stopwatch stage_;
    std::string still_;  // its file, once it is there
};

}  // namespace grainreel
