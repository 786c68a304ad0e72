// Makes a film of files that another program is still writing: each frame is drawn once it is complete. The
// film ends when nothing new has come for a while, or with Ctrl-C.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/film/run/folder_film.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct FollowRequest {
    std::filesystem::path from;  // a file, a pattern, a folder
    ReadingOptions reading{};
    Assignments sets{};            // values given to keys of the film
    std::filesystem::path beside;  // the folder in which the film lies without --out
    double idle = 60;              // s without a new frame, after which the film ends
};

class FollowRun final : public FilmJob {
  public:
    // Waits for the first frame, as long as `idle` allows. Throws UserError, before anything is written, when
    // no frame comes and when files or options are wrong.
    FollowRun(const FilmRequest& request, const FollowRequest& what, Listener& listener);

  private:
    bool work() override;
    std::string stopped_text() const override;
    void report_written() override;
    std::size_t whole_frames(bool at_end) const;
    // Draws all frames that have come. False when told to stop.
    bool draw_new(bool at_end);
    void show_progress();
    // Looks for more frames; throws RunError when files were truncated or replaced.
    void look_again();

    FollowRequest what_;
    std::unique_ptr<ForeignArchive> frames_;
    FilmedScene scene_;
    std::size_t drawn_ = 0;
    std::string wrong_;  // what was wrong with the files at the last look; empty: nothing
};

}  // namespace grainreel
