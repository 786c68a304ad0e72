// The verb `compare`: several scenes, or finished runs, in one film, side by side and in step.
#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/cli/options/option_groups.hpp"
#include "render/cli/report/film_report.hpp"
#include "render/cli/report/record.hpp"
#include "render/cli/verbs/verb.hpp"
#include "render/run/compare/compare_run.hpp"

namespace grainreel {
namespace {

class Compare final : public Verb {
  public:
    Compare()
        : Verb("compare", "Run scenes and film them side by side, in step",
               fmt::format(
                   "Rate, size and segments of the film are those of the first scene; --set and its like go "
                   "to\n"
                   "every scene. All panels show the same moment, at the same scale where they can.\n{}",
                   exit_statuses)) {}

    void add_options(CLI::App& parser) override {
        parser
            .add_option("SCENE", request_.inputs,
                        "Two to six scenes to run, or folders of finished runs to draw from")
            ->required()
            ->type_name("FILE|DIR");
        add_captions(parser);
        add_scene_keys(parser, request_.sets);
        add_film(parser, film_,
                 "Folder of the film, with one in it for each run [output/ and the scenes' names]");
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        film_.command = command;
        film_.program = program_info();
        CompareRun comparison(film_, reporter, read_comparison(request_, film_));
        return tell_folder(comparison.run(), film_);
    }

  private:
    void add_captions(CLI::App& parser) {
        parser
            .add_option_function<std::string>(
                "--captions",
                [this](const std::string& text) {
                    check_typed("--captions", text);
                    request_.captions = text;
                },
                "One a panel, bars between them, as in \"Γ = 1|Γ = 3\" [what differs: the drives, else the "
                "titles]")
            ->type_name("TEXT");
    }

    CompareRequest request_;
    FilmRequest film_;
};

}  // namespace

std::unique_ptr<Verb> compare_verb() {
    return std::make_unique<Compare>();
}

}  // namespace grainreel
