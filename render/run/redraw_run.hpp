// A film of the frames of a run that lies on disk.
#pragma once

#include <string>
#include <vector>

#include "render/run/film_run.hpp"
#include "render/run/frames/frame_source.hpp"

namespace grainreel {

class RedrawRun final : public FilmRun {
  public:
    // Throws UserError for what the options get wrong; nothing is on disk then.
    // source: one with an archive.
    RedrawRun(const FilmRequest& request, const RenderRequest& what, RunListener& listener,
              FrameSource& source);

  private:
    bool work() override;
    std::string stopped_text() const override;
    void report_written() override;
    std::vector<std::string> warnings() const;

    FrameSource& source_;
    const FrameArchive& archive_;
    const std::vector<Frame> moments_;  // that are drawn
    Scene scene_;                       // the run's, with a film of those
};

}  // namespace grainreel
