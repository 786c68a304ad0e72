// One run of the verb `compare`, from the accepted scenes to the closed files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/run/compare/comparison.hpp"
#include "render/run/film_run.hpp"

namespace grainreel {

class CompareRun final : public FilmRun {
  public:
    CompareRun(const FilmRequest& options, Reporter& reporter, Comparison all);

  private:
    bool work() override;
    void keep_state() override;
    void conclude() override;
    std::string stopped_text() const override;
    void report_written() override;

    void begin();
    // Does the same for every panel at once, and shows how far they are; false when asked to stop.
    using Work = std::function<bool(ComparePanel&, Frames::value_type&)>;
    bool for_all(Progress::Stage stage, Frames& frames, const Work& work);
    void show_progress(Progress::Stage stage);

    Comparison all_;
    Stopwatch stage_;
};

}  // namespace grainreel
