#include "render/film/compare/compare_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <atomic>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/questions/discharge.hpp"
#include "render/film/compare/comparison_words.hpp"
#include "render/film/production/picture_files.hpp"
#include "render/film/run/still.hpp"
#include "render/picture/base/pdf_page.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/panels/side_by_side.hpp"

namespace grainreel {

CompareJob::CompareJob(const FilmRequest& request, Listener& listener, Comparison all)
    : FilmJob(request, listener), all_(std::move(all)) {
    film_.use_threads(all_.threads);
    if (!all_.still) film_.check(all_.film, all_.film_pictures);
    if (all_.still && request.to_stdout)
        throw UserError("--out -: with --at there is no film; name a folder");
    make_folder({all_.film.name, request.base, request.out, request.force});
}

void CompareJob::begin() {
    const std::vector<Instant>& instants = all_.pictures.instants;
    for (const auto& member : all_.members) {
        desk_.record.panels.push_back(member->place());
        if (member->archive() != nullptr)
            desk_.record.drawn.push_back({member->place(), static_cast<std::int64_t>(instants.size()),
                                          instants.front().time, instants.back().time});
    }
    desk_.record.captions = all_.captions;
    desk_.record.title = all_.film.film.title;
    begin_record(all_.warnings);
    for (const auto& member : all_.members) member->begin(folder(), request_);
}

std::function<bool()> CompareJob::go_on() const {
    return [this] { return desk_.listener.stop_signal() == 0; };
}

bool CompareJob::work() {
    begin();
    Shots frames(all_.members.size());
    const auto pack = [this](ComparedMember& member, ShotPtr&) { return member.pack(go_on()); };
    if (!for_all(Stage::packing, frames, pack)) return false;
    mark_begun();
    for (const auto& member : all_.members)
        if (const std::string found = member->found_packing_text(); !found.empty())
            desk_.listener.info(fmt::format("{}: {}", member->place(), found));
    for (const auto& member : all_.members) member->start(all_.pictures);
    for (Panel& panel : all_.panels)
        settle_orbit(panel.scene.film.camera, static_cast<double>(all_.film_pictures) / all_.film.film.rate);
    return (all_.still ? draw_still(frames) : draw_film(frames)) && finish(frames);
}

// Takes the next picture of every panel, each in the panel's own thread.
bool CompareJob::next(Shots& frames) {
    return for_all(Stage::pictures, frames, [this](ComparedMember& member, ShotPtr& frame) {
        frame = member.next(go_on());
        return frame != nullptr;
    });
}

// Runs all members to their ends.
bool CompareJob::finish(Shots& frames) {
    return for_all(Stage::pictures, frames, [this](ComparedMember& member, ShotPtr&) {
        member.next(go_on());
        return desk_.listener.stop_signal() == 0;
    });
}

bool CompareJob::draw_still(Shots& frames) {
    const Instant moment = all_.pictures.instants.back();
    stage_ = Stopwatch();
    SideBySide drawer(all_.panels, all_.film.film, film_.threads().raster, film_.request().gl);
    for (std::size_t earlier = 0; earlier + 1 < all_.pictures.instants.size(); ++earlier) {
        if (!next(frames)) return false;
        if (earlier == 0) drawer.start_from(frames);
        drawer.remember(frames);
    }
    if (!next(frames)) return false;
    if (const std::string note = drawer.gl_note(); !note.empty()) desk_.listener.info(note);
    desk_.record.gl = drawer.gl_description();
    const auto segment = static_cast<std::size_t>(moment.segment);
    const State& state = *frames[all_.reference];
    still_ = fmt::format("still-{}s.{}", seconds_in_names(moment.time), all_.pdf ? "pdf" : "png");
    if (all_.pdf) {
        PdfPage page(all_.film.film.width, all_.film.film.height, all_.dots_an_inch);
        drawer.draw_page(page, frames, segment, all_.reference, *all_.still);
        replace_file(folder() / still_, page.finish(title_of_still(all_.film, state)));
        return true;
    }
    const Picture& picture = drawer.draw(frames, segment, all_.reference, *all_.still);
    write_png(folder() / still_, picture, texts_of(all_.film.name, all_.film.title, state, ""),
              all_.film.film.transparent, all_.dots_an_inch);
    return true;
}

bool CompareJob::draw_film(Shots& frames) {
    const std::vector<Instant>& instants = all_.pictures.instants;
    std::vector<std::size_t> segment_of;
    for (const Instant& instant : instants) segment_of.push_back(static_cast<std::size_t>(instant.segment));
    film_.open(all_.film, static_cast<std::int64_t>(instants.size()), nullptr,
               side_by_side_drawer(all_.panels, all_.film.film, film_.threads().raster, film_.request().gl,
                                   all_.reference, segment_of));
    stage_ = Stopwatch();
    for (const std::size_t segment : segment_of) {
        if (!next(frames)) return false;
        const auto timer = desk_.times.during("waiting for the film");
        film_.note(*frames[all_.reference]);
        film_.maker().take(frames, playback_of_all(all_.panels, segment));
    }
    return true;
}

const char* CompareJob::name_of(Stage stage) const {
    return stage == Stage::packing ? "packing" : all_.all_recorded() ? "reading" : "engine";
}

bool CompareJob::for_all(Stage stage, Shots& frames, const Work& work) {
    const auto timer = desk_.times.during(name_of(stage));
    std::atomic<bool> all_well = true;
    std::vector<std::function<void()>> works;
    for (std::size_t i = 0; i < all_.members.size(); ++i)
        works.push_back([&, i] {
            try {
                if (!work(*all_.members[i], frames[i])) all_well = false;
            } catch (const std::exception& problem) {
                all_.members[i]->note_failure(problem.what());
                throw;
            }
        });
    run_together(works, [&] { show_progress(stage); });
    show_progress(stage);
    return all_well;
}

void CompareJob::show_progress(Stage stage) {
    if (all_.all_recorded()) {
        if (stage == Stage::pictures && film_.is_open()) film_.show_progress();
        return;
    }
    Progress progress;
    progress.stage = stage == Stage::packing ? Progress::Stage::growing : Progress::Stage::vibrating;
    double runs = 0;
    for (const auto& member : all_.members) {
        if (member->run() == nullptr) continue;
        ++runs;
        progress.done += member->done();
        progress.particle_steps_per_second += member->speed();
    }
    progress.done /= runs;
    progress.end = all_.pictures.instants.back().time;
    progress.time = progress.done * progress.end;
    progress.frames = film_.frames_done();
    progress.frames_planned = film_.frames_planned();
    progress.elapsed = desk_.watch.seconds();
    const double seconds = stage_.seconds();
    if (stage == Stage::pictures && progress.done > 0 && seconds > 1)
        progress.remaining = seconds * (1 - progress.done) / progress.done;
    desk_.listener.progress(progress);
}

void CompareJob::keep_state() {
    for (const auto& member : all_.members) member->keep_state();
}

void CompareJob::side_work_closed() {
    const auto watcher = [&](const std::string& format, double done) { return tell_export(format, done); };
    for (const auto& member : all_.members) member->write_other_formats(watcher);
    film_.write_times();
}

void CompareJob::conclude() {
    for (const auto& member : all_.members)
        member->close(desk_.record.status, *desk_.record.exit_status, desk_.failure);
}

std::string CompareJob::stopped_text() const {
    if (all_.still) return "stopped";
    return fmt::format("stopped at frame {} of {}", film_.result().frames, film_.frames_planned());
}

void CompareJob::report_written() {
    std::vector<std::string> folders;
    for (const auto& member : all_.members) {
        if (member->run() == nullptr) continue;
        folders.push_back(member->place() + "/");
        for (const std::string& line : member->news())
            desk_.listener.warning(fmt::format("{}: {}", member->place(), line));
    }
    const std::string runs =
        folders.empty() ? "" : fmt::format("{} (each a run), ", fmt::join(folders, ", "));
    desk_.listener.info(fmt::format("wrote {}: {}{}run.json, log.txt{}", folder().string(),
                                    all_.still && !still_.empty() ? still_ + ", " : film_.files_text(), runs,
                                    page_text()));
    desk_.listener.info(fmt::format("took {}: {} panels, from {:.6g} to {:.6g} s",
                                    duration_text(desk_.watch.seconds()), all_.members.size(),
                                    all_.pictures.instants.front().time, all_.pictures.instants.back().time));
    for (const auto& member : all_.members) {
        if (member->run() == nullptr) continue;
        for (const std::string& line : discharge_lines(folder() / member->place(), member->scene()))
            desk_.listener.info(fmt::format("{}: {}", member->place(), line));
    }
}

namespace {

class SideBySideDrawer final : public Drawer {
  public:
    SideBySideDrawer(const std::vector<Panel>& panels, const Film& film, int raster_threads,
                     gl::Provider provider, std::size_t clock, std::vector<std::size_t> segments)
        : panels_(panels, film, raster_threads, provider),
          clock_(clock),
          segments_(std::move(segments)),
          rate_(film.rate) {}
    void draw(const Shots& frames, const std::string&, Picture& into) override {
        into = panels_.draw(frames, segments_.at(drawn_), clock_, static_cast<double>(drawn_) / rate_);
        ++drawn_;
    }
    std::string description() const override { return panels_.gl_description(); }
    std::string note() const override { return panels_.gl_note(); }
    std::string last_note() const override { return panels_.last_note(); }

  private:
    SideBySide panels_;
    const std::size_t clock_;
    const std::vector<std::size_t> segments_;
    const double rate_;
    std::size_t drawn_ = 0;
};

}  // namespace

DrawerMaker side_by_side_drawer(const std::vector<Panel>& panels, const Film& film, int raster_threads,
                                gl::Provider provider, std::size_t clock, std::vector<std::size_t> segments) {
    return [=] {
        return std::make_unique<SideBySideDrawer>(panels, film, raster_threads, provider, clock, segments);
    };
}

}  // namespace grainreel
