// What every verb does that fills a folder with a film: folder, log, record, film, and an end that keeps what
// there is, whatever happened.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/log.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/files/run_json.hpp"
#include "render/film/production/film_maker.hpp"
#include "render/run/film_request.hpp"
#include "render/run/first_failure.hpp"
#include "render/run/listener.hpp"
#include "render/run/stage_times.hpp"
#include "render/run/thread_plan.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class FilmRun {
  public:
    virtual ~FilmRun();
    FilmRun(const FilmRun&) = delete;
    FilmRun& operator=(const FilmRun&) = delete;

    struct Ended {
        // 0, 1 when it failed on its way (what it had is kept), 129, 130 or 143 when it was asked to stop.
        int exit_status = 0;
        std::optional<std::filesystem::path> folder;  // none once somebody has removed or replaced it
    };
    // Throws UserError before anything is worth keeping; nothing is on disk then.
    Ended run();
    const std::filesystem::path& folder() const { return folder_->path(); }

  protected:
    FilmRun(const FilmRequest& request, RunListener& listener);

    // The work itself, between the made folder and the closed film; false when asked to stop.
    virtual bool work() = 0;
    // After the work, whatever happened, and before the film is finished, which may take its time: what else
    // is to be kept.
    virtual void keep_state() {}
    // What the record says of that. By then the record has its status. May be called twice.
    virtual void conclude() {}
    // The film is closed and has so many frames.
    virtual void film_closed(std::int64_t /*frames*/) {}
    // Whether the run goes on in its folder and has not come to where it was, so that the folder is to be put
    // back as it was; and that it is, by a run that calls nothing else afterwards.
    virtual bool is_behind_former() const { return false; }
    virtual void put_back() {}
    virtual std::string stopped_text() const = 0;  // "stopped at 0.10 of 0.20 s"
    virtual void report_written() = 0;             // that which went well

    bool wants_pictures() const { return request_.film || request_.frames; }
    // What scene and options ask of the film's file. Throws UserError.
    void check_film(const FilmedScene& scene, std::int64_t frames) const;
    // To be called when all that the user gave has been accepted.
    void make_folder(RunFolderRequest request);
    // From here a mistake is a failure, and what there is stays, also at a second signal.
    void mark_begun();
    // Shows the warnings and writes run.json for the first time.
    void begin_record(const std::vector<std::string>& warnings);
    // draw: what makes pictures; none for the Renderer.
    void open_film(const FilmedScene& scene, DrawerMaker draw = {});
    std::string film_files_text() const;  // "movie.mp4 (4 frames), poster.png, "
    std::string page_text() const;        // ", report.html"; empty without a page

    // Of what is drawn alone.
    void show_drawing();

    const FilmRequest request_;
    LoggingListener listener_;
    Stopwatch watch_;
    ThreadPlan threads_;
    std::optional<RunFolder> folder_;
    std::optional<RunLog> log_;
    RunRecord record_;
    StageTimes times_;
    std::unique_ptr<FilmMaker> film_;
    std::int64_t frames_planned_ = 0;  // of the film: its pictures, and those that are held for captions
    std::int64_t pictures_planned_ = 0;
    FramePtr start_;  // from which the film's start heights are counted; null: from its first picture
    FilmReport film_report_;
    FirstFailure failure_;

  private:
    void note_folder();
    void find_folder();
    void close_film();
    Ended end_as_before(bool mistaken);
    void settle_status(bool stopped);
    void close_record(bool stopped);
    void write_record();
    void make_page();
    void page_is_missing(bool missing);
    void stop_before_page();
    void report_end();

    bool begun_ = false;
    bool has_film_ = false;   // a film was made and is closed
    bool has_folder_ = true;  // false once somebody has removed or replaced it
};

}  // namespace grainreel
