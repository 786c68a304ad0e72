// One run of the verb `movie`, from the accepted scene to the closed files.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/output/log.hpp"
#include "engine/output/run_folder.hpp"
#include "engine/output/run_json.hpp"
#include "engine/run/simulation.hpp"
#include "engine/scene/plan.hpp"
#include "engine/scene/scene.hpp"
#include "render/cli/agenda.hpp"
#include "render/cli/options.hpp"
#include "render/cli/pace.hpp"
#include "render/cli/reporter.hpp"
#include "render/cli/run_files.hpp"
#include "render/cli/stage_times.hpp"
#include "render/cli/thread_plan.hpp"
#include "render/film/film_maker.hpp"
#include "render/film/sampler.hpp"

namespace grainreel {

class MovieRun {
  public:
    // Throws UserError for what scene, plan or options get wrong; nothing is on disk then.
    MovieRun(const Options& options, Reporter& reporter, const Scene& scene, const Plan& plan);
    ~MovieRun();

    // See make_movie().
    int run();

  private:
    bool wants_pictures() const { return options_.film || options_.frames; }
    void begin_record(const std::vector<std::string>& warnings);
    void describe();

    // Both return false when the run was asked to stop.
    bool pack();
    bool vibrate();

    void open_files();
    bool advance_to(std::int64_t step);
    void serve(const Stop& stop);
    void show_progress();
    void save_checkpoint();

    // The ends: each keeps what it can and notes the first failure.
    template <class Action>
    void attempt(const Action& action);
    void close_film();
    void close_state();
    void close_record();
    void report_end();
    std::string files_text() const;
    void report_segregation() const;

    const Options& options_;
    Reporter& reporter_;
    const Scene& scene_;
    const Plan& plan_;
    Stopwatch watch_;
    ThreadPlan threads_;
    std::vector<Shot> shots_;
    std::optional<Simulation> simulation_;
    RunFolder folder_;
    RunLog log_;
    RunRecord record_;
    StageTimes times_;

    bool packed_ = false;
    std::int64_t first_step_ = 0;
    std::optional<RunFiles> files_;
    std::unique_ptr<FilmMaker> film_;
    std::int64_t pictures_planned_ = 0;
    FilmReport film_report_;
    Pace pace_;
    std::optional<Stopwatch> vibrating_;
    Stopwatch since_checkpoint_;
    double particle_steps_ = 0;  // of vibration
    RecentRate rate_;            // particle-steps/s
    std::string failure_;        // the first; empty while all is well
};

}  // namespace grainreel
