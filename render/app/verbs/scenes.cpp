// The verb `scenes` lists the scenes that come with the program.
#include <algorithm>

#include <fmt/format.h>

#include "engine/scene/shipped/shipped_scenes.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/verbs/verbs.hpp"

namespace grainreel {
namespace {

class Scenes final : public Verb {
  public:
    Scenes()
        : Verb("scenes", "List the scenes that come with the program",
               "Each runs by its name from any folder:  grainreel movie wedge_segregation\n"
               "To get one as a file that you can change:  grainreel new --from wedge_segregation\n"
               "Exit status: 0 done, 2 a mistake in the options.") {}

    void add_options(CLI::App&) override {}

    int run(Reporter&) override {
        std::size_t width = 0;
        for (const ShippedScene& scene : shipped_scenes()) width = std::max(width, scene.name.size());
        std::string text;
        for (const ShippedScene& scene : shipped_scenes())
            text += fmt::format("{:<{}}  {}\n", scene.name, width, scene.about());
        print_result(text);
        return 0;
    }

    bool ends_in_good_order() const override { return false; }
};

}  // namespace

std::unique_ptr<Verb> scenes_verb() {
    return std::make_unique<Scenes>();
}

}  // namespace grainreel
