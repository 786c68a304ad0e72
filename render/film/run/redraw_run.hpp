// A film of a run that lies on disk: its film once more, with other words, from another side, or cut; or the
// frames that its trajectory kept, one after the other.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/film/run/film_in_parts.hpp"
#include "render/film/run/folder_film.hpp"
#include "render/film/sources/revisited_run.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class RedrawRun final : public FilmRun {
  public:
    // Throws UserError for what the options get wrong; nothing is on disk then.
    RedrawRun(const FilmRequest& request, const RenderRequest& what, RunListener& listener,
              RevisitedRun& source);
    // Throws the same errors, and does nothing else.
    static void check(const FilmRequest& request, const RenderRequest& what, RunListener& listener,
                      RevisitedRun& source);

  private:
    enum class Folder { none, made };
    RedrawRun(const FilmRequest& request, const RenderRequest& what, RunListener& listener,
              RevisitedRun& source, Folder folder);
    bool work() override;
    std::string stopped_text() const override;
    void report_written() override;
    void side_work_closed() override;
    void identify_part();
    void choose_parts(const PartsWanted& wanted);
    // Those of the shots that are drawn.
    std::vector<Shot> drawn() const;
    void choose_pictures(const RenderRequest& what);
    void choose_kept(const RenderRequest& what);
    void show_what_there_is();
    FramePtr first_of_film(const FrameSource::GoOn& go_on);
    std::vector<std::string> warnings() const;
    std::string caption_of(const Taken& picture) const;

    RevisitedRun& source_;
    FilmedScene scene_;        // the run's, with a film of those
    std::vector<Shot> shots_;  // of the film, each as it is shown
    std::optional<FilmInParts> parts_;
    bool kept_alone_ = false;                                     // frames of the trajectory
    std::size_t brought_back_ = 0, replaced_ = 0, left_out_ = 0;  // of the shots
    std::vector<std::string>
        captions_;  // of segments whose pictures are not where they should be; else empty
};

}  // namespace grainreel
