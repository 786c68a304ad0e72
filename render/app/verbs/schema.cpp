// The verb `schema` prints a JSON Schema of scene or study files, by which editors complete and check them.
#include <fmt/format.h>

#include "engine/scene/keys/json_schema.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/study/file/read_study.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

class Schema final : public Verb {
  public:
    Schema()
        : Verb("schema", "Print a JSON Schema of scene files, for editors",
               "An editor with taplo (Even Better TOML, for one) completes and checks a scene whose first "
               "line\n"
               "names the schema:\n"
               "  grainreel schema > scene.schema.json\n"
               "  #:schema ./scene.schema.json\n"
               "`check` knows more than a schema can say, so it has the last word.\n"
               "Exit status: 0 done, 2 a mistake in the options.") {}

    void add_options(CLI::App& parser) override {
        parser.add_option("KIND", kind_, "Kind of file: scene or study [scene]")
            ->option_text("[KIND]")
            ->check(CLI::IsMember({"scene", "study"}));
    }

    int run(Reporter&) override {
        print_exact(kind_ == "study" ? json_schema(study_keys(), "A study for grainreel") : scene_schema());
        return 0;
    }

    bool ends_in_good_order() const override { return false; }

  private:
    std::string kind_ = "scene";
};

}  // namespace

std::unique_ptr<Verb> schema_verb() {
    return std::make_unique<Schema>();
}

}  // namespace grainreel
