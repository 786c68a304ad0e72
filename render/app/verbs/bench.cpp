// The verb `bench` measures how fast the engine and the drawing are on known beds.
#include <fmt/format.h>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/base/error.hpp"
#include "engine/lab/bench/bench_run.hpp"
#include "engine/vector/instructions.hpp"
#include "render/app/bench_render.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/scene/film.hpp"

namespace grainreel {

namespace {

// In the order of enum Cost (engine/step/threads/work_shares.hpp).
constexpr const char* stage_names[kCosts] = {"neighbours", "contacts",  "walls",
                                             "gather",     "integrate", "other"};
const char* precision_name(Precision precision) {
    return precision == Precision::mixed ? "mixed" : "double";
}

std::string bench_json(const BenchResult& result) {
    using Json = nlohmann::ordered_json;
    Json phases = Json::array();
    for (const PhaseResult& phase : result.phases) {
        Json stages = Json::object();
        for (int s = 0; s < kCosts; ++s) stages[stage_names[s]] = phase.stage[s];
        Json entry = {{"name", phase.name},
                      {"steps", phase.steps},
                      {"particle_steps_per_s", phase.median()},
                      {"repetitions", phase.particle_steps},
                      {"pairs_listed", phase.listed},
                      {"pairs_touching", phase.touching},
                      {"ns_per_particle_step", stages}};
        if (!phase.of_one_copy.empty())
            entry["particle_steps_per_s_of_one_copy"] = phase.median_of_one_copy();
        phases.push_back(entry);
    }
    const Json all = {{"case", result.name},
                      {"particles", result.particles},
                      {"threads", result.threads},
                      {"precision", precision_name(result.precision)},
                      {"vector_width", vector_instructions()},
                      {"bytes_per_particle", result.bytes_per_particle},
                      {"state_hash", fmt::format("{:016x}", result.state_hash)},
                      {"phases", phases}};
    return all.dump(2);
}

std::string bench_table(const BenchResult& result, bool quick) {
    std::string text = fmt::format(
        "{}: {} grains, {} thread{}, {}, vectors {}, {:.0f} bytes a grain, state "
        "{:016x}\n\n{:<10}{:>8}{:>12}{:>8}",
        result.name, result.particles, result.threads, result.threads == 1 ? "" : "s",
        precision_name(result.precision), vector_instructions(), result.bytes_per_particle, result.state_hash,
        "phase", "steps", "M steps/s", "spread");
    for (const char* name : stage_names) text += fmt::format("{:>12}", name);
    text += fmt::format("{:>10}{:>10}\n", "listed", "touching");
    for (const PhaseResult& phase : result.phases) {
        text += fmt::format("{:<10}{:>8}{:>12.2f}{:>6.0f} %", phase.name, phase.steps, 1e-6 * phase.median(),
                            100 * phase.spread());
        for (const double ns : phase.stage) text += fmt::format("{:>9.1f} ns", ns);
        const double n = static_cast<double>(result.particles);
        text += fmt::format("{:>10.2f}{:>10.2f}\n", static_cast<double>(phase.listed) / n,
                            static_cast<double>(phase.touching) / n);
    }
    for (const PhaseResult& phase : result.phases) {
        if (phase.of_one_copy.empty()) continue;
        text += fmt::format("\n{}: a single copy in the same steps {:.2f} M steps/s, {:.2f} times as many\n",
                            phase.name, 1e-6 * phase.median_of_one_copy(),
                            phase.median_of_one_copy() / phase.median());
    }
    text += "\nM steps/s: million grain-steps a second; ns: of a thread, a step and grain; pairs a grain";
    if (quick)
        text += "\n--quick: a tenth of the steps; the bed is hardly settled, and whole runs are slower";
    return text;
}

void read_size(const std::string& size, Film& film) {
    int end = 0;
    const bool read = std::sscanf(size.c_str(), "%dx%d%n", &film.width, &film.height, &end) == 2;
    if (!read || end != static_cast<int>(size.size()) || std::min(film.width, film.height) < 64 ||
        std::max(film.width, film.height) > 8192)
        throw UserError("--size {}: must be width x height, each from 64 to 8192, as in 1920x1080", size);
}

void set_style(const std::string& style, BenchRenderRequest& request) {
    request.style = style;
    Film& film = request.film;
    const bool bare = style == "plain" || style == "flat";
    film.look.occlusion = film.look.shadows = film.look.ground = !bare;
    film.look.style = style == "flat"   ? FilmLook::Style::flat
                      : style == "dark" ? FilmLook::Style::dark
                                        : FilmLook::Style::studio;
    film.background = default_background(film.look.style);
}

class Bench final : public Verb {
  public:
    Bench()
        : Verb(
              "bench", "Measure the speed of the engine on a standard bed",
              "Results go to stdout, progress to stderr.\n"
              "Exit status: 0 done, 1 the run failed, 2 a mistake in the options, 130 Ctrl-C, 143 SIGTERM.") {
    }

    void add_options(CLI::App& parser) override {
        Choices cases(bench_cases());
        cases.add("render", "drawing a bed at rest, stage by stage");
        parser.add_option("CASE", case_, cases.about)
            ->required()
            ->check(CLI::IsMember(cases.names))
            ->type_name("CASE");
        add_bed_options(parser);
        add_render_options(parser);
        parser.add_flag("--quick", request_.quick,
                        "Run a tenth of the steps, to try it; the bed is then hardly settled, so the figures "
                        "are not those of a whole run");
        parser.add_flag("--json", json_, "Print a JSON object in place of a table");
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        if (case_ == "render") {
            render_.threads = request_.threads;
            render_.repeats = request_.repeats;
            render_.json = json_;
            return bench_render(render_, reporter);
        }
        const auto& cases = bench_cases();
        const auto chosen =
            std::find_if(cases.begin(), cases.end(), [&](const BenchCase& c) { return c.name == case_; });
        GRAINREEL_CHECK(chosen != cases.end());
        const BenchOutcome outcome =
            run_bench(*chosen, request_, ShareWatcher(reporter, Progress::Stage::timing));
        reporter.clear();
        if (!outcome.complete) {
            reporter.info("stopped; nothing was measured to its end");
            return signal_base + stop_signal();
        }
        print_result((json_ ? bench_json(outcome.result) : bench_table(outcome.result, request_.quick)) +
                     "\n");
        return 0;
    }

  private:
    void add_bed_options(CLI::App& parser) {
        parser.add_option("--threads", request_.threads, "Threads [as many as there are processors]")
            ->check(CLI::Range(1, 1024))
            ->type_name("N");
        parser
            .add_option_function<std::string>(
                "--precision",
                [this](const std::string& word) {
                    request_.precision = word == "mixed" ? Precision::mixed : Precision::full;
                },
                "double or mixed [double]")
            ->check(CLI::IsMember({"double", "mixed"}))
            ->type_name("WHICH");
        parser
            .add_option("--particles", request_.particles,
                        "Number of grains [that of the case]; for render: --grains")
            ->check(CLI::Range(100, 10000000))
            ->type_name("N");
        parser.add_option("--repeat", request_.repeats, "Run everything K times and give medians [1]")
            ->check(CLI::Range(1, 1000))
            ->type_name("K");
    }

    void add_render_options(CLI::App& parser) {
        parser.add_option("--grains", render_.grains, "render: grains in the bed [10125]")
            ->check(CLI::Range(100, 10000000))
            ->type_name("N");
        parser
            .add_option_function<std::string>(
                "--size", [this](const std::string& size) { read_size(size, render_.film); },
                "render: size of the picture in pixels [1920x1080]")
            ->type_name("WxH");
        add_out_folder(
            parser, render_.out,
            "render: keep the picture, and the grains and camera for other renderers, in this folder");
        parser
            .add_option_function<std::string>(
                "--style", [this](const std::string& style) { set_style(style, render_); },
                "render: studio, flat, dark or plain (lit spheres alone) [studio]")
            ->check(CLI::IsMember({"studio", "flat", "dark", "plain"}))
            ->type_name("WHICH");
        parser.add_flag_callback(
            "--orthographic", [this] { render_.film.camera.field_of_view = 0; },
            "render: with an orthographic camera");
        parser
            .add_option("--zoom", render_.film.camera.zoom,
                        "render: enlargement; at 1 the grains fill the picture's height or width [1]")
            ->type_name("Z")
            ->check(CLI::Range(0.01, 100.0));
    }

    std::string case_;
    BenchRequest request_;
    BenchRenderRequest render_;
    bool json_ = false;
};

}  // namespace

std::unique_ptr<Verb> bench_verb() {
    return std::make_unique<Bench>();
}

}  // namespace grainreel
