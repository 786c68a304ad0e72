#include <cstdio>
#include <exception>
#include <optional>
#include <sstream>

#include "engine/base/error.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation.hpp"
#include "engine/scene/text/reader.hpp"
#include "render/cli/options/options.hpp"
#include "render/cli/report/reporter.hpp"
#include "render/cli/report/result.hpp"
#include "render/cli/verbs/bench.hpp"
#include "render/cli/verbs/chart.hpp"
#include "render/cli/verbs/check.hpp"
#include "render/cli/verbs/compare.hpp"
#include "render/cli/verbs/movie.hpp"
#include "render/cli/verbs/render.hpp"
#include "render/run/stop_signal.hpp"

namespace {

constexpr int run_failed = 1, user_mistake = 2;

int check(const grainreel::Options& options) {
    const grainreel::Scene scene = grainreel::read_scene(options.scene, options.sets);
    const grainreel::Plan plan = grainreel::make_plan(scene);
    grainreel::check_start(scene, plan);
    std::ostringstream text;
    grainreel::print_plan(scene, plan, text);
    grainreel::print_result(text.str());
    return 0;
}

int run_verb(const grainreel::Options& options, grainreel::Reporter& reporter) {
    switch (options.verb) {
        case grainreel::Options::Verb::movie:
            return grainreel::make_movie(options, reporter);
        case grainreel::Options::Verb::render:
            return grainreel::draw_again(options, reporter);
        case grainreel::Options::Verb::compare:
            return grainreel::make_comparison(options, reporter);
        case grainreel::Options::Verb::chart:
            return grainreel::make_chart(options, reporter);
        case grainreel::Options::Verb::bench:
            return grainreel::run_bench(options, reporter);
        case grainreel::Options::Verb::check:
            break;
    }
    return check(options);
}

int run(const grainreel::Options& options, grainreel::Reporter& reporter) {
    try {
        const int status = run_verb(options, reporter);
        grainreel::close_results();
        return status;
    } catch (const grainreel::UserError& mistake) {
        reporter.error(mistake.what());
        return user_mistake;
    } catch (const std::exception& failure) {
        reporter.error(failure.what());
        return run_failed;
    }
}

}  // namespace

int main(int argc, char** argv) {
    grainreel::ignore_write_signals();
    try {
        const std::optional<grainreel::Options> options = grainreel::parse_options(argc, argv);
        if (!options) {
            grainreel::close_results();
            return 0;
        }
        grainreel::Reporter reporter(options->report);
        if (options->verb != grainreel::Options::Verb::check)
            grainreel::install_stop_handlers(reporter.last_words());
        return run(*options, reporter);
    } catch (const grainreel::UserError& mistake) {
        std::fprintf(stderr, "error: %s\n", mistake.what());
        return user_mistake;
    } catch (const grainreel::RunError& failure) {
        std::fprintf(stderr, "error: %s\n", failure.what());
        return run_failed;
    }
}
