// Draws a film of a run that lies on disk: the run's film once more, perhaps with other words, from another
// side, or of a part of the time; or the frames of the trajectory one after another.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/film/run/film_in_parts.hpp"
#include "render/film/run/folder_film.hpp"
#include "render/film/sources/stored_shots.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class RedrawJob final : public FilmJob {
  public:
    // Throws UserError, before anything is written, when options are wrong.
    RedrawJob(const FilmRequest& request, const RenderRequest& what, Listener& listener, StoredShots& source);
    // Throws the same errors and does nothing else.
    static void check(const FilmRequest& request, const RenderRequest& what, Listener& listener,
                      StoredShots& source);

  private:
    enum class Folder { none, made };
    RedrawJob(const FilmRequest& request, const RenderRequest& what, Listener& listener, StoredShots& source,
              Folder folder);
    bool work() override;
    std::string stopped_text() const override;
    void report_written() override;
    void side_work_closed() override;
    void identify_part();
    void choose_parts(const PartsWanted& wanted);
    // The shots that are drawn.
    std::vector<Due> drawn() const;
    void choose_pictures(const RenderRequest& what);
    void choose_kept(const RenderRequest& what);
    void show_what_there_is();
    StatePtr first_of_film(const ShotSource::GoOn& go_on);
    std::vector<std::string> warnings() const;
    std::string caption_of(const Taken& picture) const;

    StoredShots& source_;
    FilmedScene scene_;        // the run's scene, with a film of these pictures
    const std::string named_;  // what the user calls what is drawn
    std::vector<Due> shots_;   // the film's shots, each at the step that is shown
    std::optional<FilmInParts> parts_;
    bool kept_alone_ = false;                                     // only frames of the trajectory are drawn
    std::size_t brought_back_ = 0, replaced_ = 0, left_out_ = 0;  // numbers of shots
    std::vector<std::string>
        captions_;  // for segments with pictures at other moments than planned; else empty
};

}  // namespace grainreel
