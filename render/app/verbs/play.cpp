// The verb `play` makes one page on which a scene is computed while one looks, with knobs.
#include <fmt/format.h>
#include <filesystem>
#include <memory>

#include "engine/base/error.hpp"
#include "engine/base/system/program.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/text/units.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/page/play/play_page.hpp"
#include "render/page/play/web_engine.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr const char* usual_name = "play.html";

class Play final : public Verb {
  public:
    Play()
        : Verb("play", "Make a page that computes a scene while one looks, with knobs to turn",
               "The page is one file. It needs no network and no server; any present browser opens it. An "
               "earlier\n"
               "page is replaced. Its grains are soft (run.accuracy = \"draft\", run.overlap = 0.05) unless "
               "the scene or\n"
               "--set says otherwise. The name of the page goes to stdout.\n"
               "Exit status: 0 done, 1 the page could not be written, 2 a mistake in the scene or the "
               "options.") {}

    void add_options(CLI::App& parser) override {
        add_scene(parser, scene_, sets_);
        parser.add_option("--out", out_, "File of the page")
            ->option_text(fmt::format("FILE [{}]", usual_name))
            ->check(not_empty());
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        check_out();
        FilmedScene scene = read_filmed_scene(scene_, sets_, measurable_in);
        const bool soft = is_open(scene);
        if (soft) {
            Assignments softer = sets_;
            for (const char* one : {"run.accuracy=draft", "run.overlap=0.05"}) softer.emplace_back(one);
            scene = read_filmed_scene(scene_, softer, measurable_in);
        }
        scene = played_scene(std::move(scene));
        const Plan plan = plan_with_film(scene);
        check_start(scene, plan);
        const WebEngine engine = web_engine();
        const std::size_t bytes = write_play_page({scene, plan, engine, soft}, out_);
        reporter.info(fmt::format("wrote {}, {}; open it in a browser", out_.string(),
                                  data_size_text(static_cast<double>(bytes))));
        print_exact(out_.string() + "\n");
        return 0;
    }

    bool ends_in_good_order() const override { return false; }

  private:
    // Whether the scene leaves it to the program how stiff its grains are.
    static bool is_open(const FilmedScene& scene) {
        for (const char* key : {"run.accuracy", "run.overlap", "run.step"})
            if (scene.written.count(key) > 0) return false;
        return true;
    }

    void check_out() const {
        std::error_code ignored;
        if (fs::is_directory(out_, ignored))
            throw UserError(fmt::format("--out: {} is a folder; give the name of a file", out_.string()));
        const fs::path folder = out_.parent_path();
        if (!folder.empty() && !fs::is_directory(folder, ignored))
            throw UserError(
                fmt::format("--out: {}: there is no such folder; make it first", folder.string()));
    }

    fs::path scene_, out_ = usual_name;
    Assignments sets_;
};

}  // namespace

std::unique_ptr<Verb> play_verb() {
    return std::make_unique<Play>();
}

}  // namespace grainreel
