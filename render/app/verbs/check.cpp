// The verb `check` says in words what a scene will do, before it is run.
#include <sstream>

#include "engine/measure/columns.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "render/app/check/print_plan.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

class Check final : public Verb {
  public:
    Check()
        : Verb("check", "Read a scene and print the plan: laws, stiffness, step, cost",
               "Exit status: 0 the scene can be run, 2 a mistake in it or in the options.") {}

    void add_options(CLI::App& parser) override { add_scene(parser, scene_, sets_); }

    int run(Reporter&) override {
        const FilmedScene scene = read_filmed_scene(scene_, sets_, measurable_in);
        const Plan plan = plan_with_film(scene);
        check_start(scene, plan);
        std::ostringstream text;
        print_plan(scene, plan, text);
        print_result(text.str());
        return 0;
    }

    bool ends_in_good_order() const override { return false; }

  private:
    std::filesystem::path scene_;
    Assignments sets_;
};

}  // namespace

std::unique_ptr<Verb> check_verb() {
    return std::make_unique<Check>();
}

}  // namespace grainreel
