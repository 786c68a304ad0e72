// A film of a finished run's frames.
#pragma once

#include <string>
#include <vector>

#include "render/run/film_run.hpp"
#include "render/run/finished_run.hpp"

namespace grainreel {

class RedrawRun final : public FilmRun {
  public:
    // Throws UserError for what the options get wrong; nothing is on disk then.
    RedrawRun(const FilmRequest& options, const RenderRequest& request, Reporter& reporter,
              const FinishedRun& run);

  private:
    bool work() override;
    std::string stopped_text() const override;
    void report_written() override;
    void show_progress();

    const FinishedRun& run_;
    std::vector<std::size_t> chosen_;  // of the run's frames
    std::vector<Frame> moments_;       // of those
    Scene scene_;                      // the run's, with a film of those
};

// The threads of a film that has the machine for itself. wanted: 0 for as many as there are.
ThreadPlan drawing_threads(int wanted);

}  // namespace grainreel
