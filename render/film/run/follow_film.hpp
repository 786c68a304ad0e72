// Makes a film of a run that another program is still computing: each picture is drawn once its frame has
// come. The film ends with the run, when nothing new has come for a while, or with Ctrl-C.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/film/run/folder_film.hpp"
#include "render/film/run/followed.hpp"
#include "render/film/sources/stored_shots.hpp"

namespace grainreel {

class FollowFilm final : public FilmJob {
  public:
    // Waits for the first frame, as long as `idle` allows. Throws UserError, before anything is written, when
    // none comes and when files or options are wrong.
    FollowFilm(const FilmRequest& request, const FollowRequest& what, Listener& listener);
    const FilmedScene& scene() const { return followed_->scene(); }

  private:
    bool work() override;
    void side_work_closed() override;
    std::string stopped_text() const override;
    void report_written() override;

    std::int64_t pictures() const;
    void check_film() { film_.check(scene(), pictures()); }
    bool stopped() const { return desk_.listener.stop_signal() != 0; }
    std::vector<std::string> warnings() const;
    // Takes what has come, for a quarter of a second at most. Returns whether there was something.
    bool read_some();
    void open_anew();
    std::vector<Due> due() const;
    // Draws all pictures whose frames have come. False when told to stop.
    bool draw_new();
    void draw(const Taken& picture);
    void finish();

    const FollowRequest what_;
    std::unique_ptr<Followed> followed_;
    Stopwatch idle_;  // since the last frame came
    std::unique_ptr<StoredShots> source_;
    // Number of frames that source_ knows, and number of those whose pictures are drawn.
    std::int64_t opened_at_ = 0, drawn_at_ = 0;
    Stopwatch since_opened_;
    double opening_ = 0;       // s that it took to open it
    std::int64_t shown_ = -1;  // step of the last picture
    std::int64_t drawn_ = 0;   // number of pictures
};

}  // namespace grainreel
