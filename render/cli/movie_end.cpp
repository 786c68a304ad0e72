// How a run ends, well or not: film and files closed, the record written, the result told.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/start/grain_table.hpp"
#include "render/cli/movie_run.hpp"
#include "render/cli/stop_signal.hpp"

namespace grainreel {

namespace {

std::int64_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

double mean_diameter(const Species& species) {
    return species.diameter.mean;
}

}  // namespace

template <class Action>
void MovieRun::attempt(const Action& action) {
    try {
        action();
    } catch (const std::exception& problem) {
        if (failure_.empty()) failure_ = problem.what();
    }
}

void MovieRun::close_film() {
    if (!film_) return;
    attempt([&] {
        const auto timer = times_.during("finishing the film");
        film_report_ = film_->finish();
        for (const std::string& note : film_report_.notes) reporter_.info(note);
    });
    film_report_.frames = film_->frames_done();
    times_.add("drawing (beside the engine)", film_report_.draw_seconds);
    times_.add("encoding (beside the engine)", film_report_.encode_seconds);
}

void MovieRun::close_state() {
    if (!packed_) return;
    const std::int64_t step = simulation_->step();
    record_.steps = step;
    record_.simulated = plan_.clock.time(step);
    attempt([&] {
        if (files_ && files_->last_measures() && files_->last_measures()->step != step) {
            files_->add_measures(simulation_->measures());
        }
    });
    attempt([&] { write_grain_table(folder_.path() / "final.csv", simulation_->frame()); });
    attempt([&] { save_checkpoint(); });
    attempt([&] { record_.state_hash = simulation_->state_hash(); });
}

void MovieRun::close_record() {
    const double engine = times_.of("engine");
    record_.error = failure_;
    record_.gl = film_report_.gl;
    record_.finished = utc_now();
    record_.particle_steps_per_second = engine > 0 ? particle_steps_ / engine : 0;
    record_.film_frames = film_report_.frames;
    record_.trajectory_frames = files_ ? files_->trajectory_frames() : 0;
    record_.measures_rows = files_ ? files_->measures_rows() : 0;
    record_.peak_memory = peak_memory();
    times_.add("total", watch_.seconds());
    record_.wall_seconds = times_.all();
    attempt([&] { write_run_json(folder_.path() / "run.json", record_); });
    if (record_.status == RunStatus::complete && failure_.empty()) folder_.remove_previous();
}

void MovieRun::report_end() {
    const std::string folder = folder_.path().string();
    if (!failure_.empty()) {
        record_.exit_status = 1;
        reporter_.error(failure_);
        reporter_.info(fmt::format("what was made until then is in {}", folder));
    } else if (record_.status == RunStatus::interrupted) {
        reporter_.info(fmt::format("stopped at {:.2f} of {:.2f} s; what was made is in {}{}",
                                   record_.simulated, plan_.clock.time(plan_.steps), folder,
                                   packed_ ? "" : " (still packing: no film)"));
    }
    if (files_ && failure_.empty()) {
        reporter_.info(fmt::format("wrote {}: {}", folder, files_text()));
        report_segregation();
        reporter_.info(fmt::format("took {}: packing {}, engine {} ({:.1f} M particle-steps/s)",
                                   duration_text(watch_.seconds()), duration_text(times_.of("packing")),
                                   duration_text(times_.of("engine")),
                                   record_.particle_steps_per_second * 1e-6));
    }
    if (!folder_.previous().empty()) {
        reporter_.info(
            fmt::format("the run that was to be replaced is kept in {}", folder_.previous().string()));
    }
}

std::string MovieRun::files_text() const {
    std::string text;
    if (options_.film) text += fmt::format("movie.mp4 ({} frames), poster.png, ", film_report_.frames);
    if (options_.frames) text += fmt::format("frames/ ({} pictures), ", film_report_.frames);
    if (plan_.trajectory_every > 0)
        text += fmt::format("trajectory.nc ({} frames), ", files_->trajectory_frames());
    if (files_->has_contacts()) text += "contacts.nc, ";
    return text +
           fmt::format("measures.csv ({} rows), final.csv, checkpoint.grs, scene.toml, run.json, log.txt",
                       files_->measures_rows());
}

void MovieRun::report_segregation() const {
    if (scene_.species.size() < 2 || !files_->last_measures()) return;
    const auto [small, big] = std::minmax_element(
        scene_.species.begin(), scene_.species.end(),
        [](const Species& a, const Species& b) { return mean_diameter(a) < mean_diameter(b); });
    const Measures& from = *files_->first_measures();
    const Measures& to = *files_->last_measures();
    std::string text =
        fmt::format("segregation: mean height of {} minus {}, over the bed's height, from {:+.2f} to {:+.2f}",
                    big->name, small->name, from.height_difference, to.height_difference);
    if (std::isfinite(from.lacey) && std::isfinite(to.lacey)) {
        text += fmt::format("; Lacey mixing index from {:.2f} to {:.2f} (1 is mixed)", from.lacey, to.lacey);
    }
    reporter_.info(text);
}

}  // namespace grainreel
