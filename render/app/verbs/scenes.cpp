// The verb `scenes` lists the scenes and studies that come with the program.
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
        : Verb("scenes", "List the scenes and studies that come with the program",
               "Each runs by its name from any folder:  grainreel movie wedge_segregation\n"
               "Studies likewise:  grainreel study brazil_nut_shaking --dry-run\n"
               "To get one as a file that you can change:  grainreel new --from wedge_segregation\n"
               "Exit status: 0 done, 2 a mistake in the options.") {}

    void add_options(CLI::App&) override {}

    int run(Reporter&) override {
        std::size_t width = 0;
        for (const auto* list : {&shipped_scenes(), &shipped_studies()})
            for (const ShippedScene& scene : *list) width = std::max(width, scene.name.size());
        std::string text;
        const auto add = [&](const std::vector<ShippedScene>& list) {
            for (const ShippedScene& scene : list)
                text += fmt::format("{:<{}}  {}\n", scene.name, width, scene.about());
        };
        add(shipped_scenes());
        text += "\nStudies:\n";
        add(shipped_studies());
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
