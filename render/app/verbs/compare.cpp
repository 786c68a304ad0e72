// The verb `compare` shows several scenes or finished runs in one film, side by side and in step.
#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/run_folder.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/options/run_to_read.hpp"
#include "render/app/verbs/report.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/film/compare/compare_job.hpp"

namespace grainreel {
namespace {

class Compare final : public Verb {
  public:
    Compare()
        : Verb("compare", "Run scenes and film them side by side, in step",
               fmt::format(
                   "Rate, size and segments of the film are those of the first scene. --set and options "
                   "such as\n"
                   "--duration go to every scene. All panels show the same moment, at the same scale if "
                   "sizes allow.\n"
                   "Moments that finished runs did not keep are brought back.\n"
                   "{}",
                   exit_statuses)) {}

    void add_options(CLI::App& parser) override {
        parser
            .add_option("SCENE", request_.inputs,
                        "Two to six scenes to run, folders of finished runs or files of other programs; with "
                        "--vary only one")
            ->required()
            ->type_name("FILE|DIR");
        add_vary(parser);
        add_captions(parser);
        CLI::Option* at = add_time(parser, "--at", request_.at,
                                   "Draw only this moment, to a PNG or PDF file in the folder");
        add_print_size(parser, request_.print);
        add_no_replay(parser, request_.replay);
        add_reading(parser, reading_);
        add_scene_keys(parser, request_.sets);
        add_camera_file(parser, camera_, CameraOptions::use);  // each panel has its own, so none is kept
        add_film(parser, film_,
                 "Folder of the film, which has a folder for each run [output/ and the scenes' names]");
        parser.add_flag("--no-report", no_page_, "Leave out report.html, the page of all runs");
        add_no_cache(parser, film_.keep_packings)->each([this](const std::string&) { no_cache_ = true; });
        for (const char* option : {"--part", "--parts"})
            parser
                .add_option_function<std::string>(
                    option,
                    [option](const std::string&) {
                        throw UserError("{}: is of render, for one run; a comparison is drawn in one go",
                                        option);
                    })
                ->group("");  // hidden from --help
        for (const char* other : {"--frames", "--no-film"}) at->excludes(parser.get_option(other));
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        check_print_size(request_.print, request_.at.has_value(), "--at");
        film_.command = command;
        film_.program = program_info();
        if (film_.out) {
            check_folder_name(*film_.out);
            RunFolder::check(*film_.out, film_.force);
        }
        bool any_foreign = false;
        for (std::filesystem::path& input : request_.inputs) {
            bring_back_to_read(input, reporter);
            if (!is_foreign(input)) continue;
            any_foreign = true;
            input = run_to_read(input, reading_, reporter).folder;
        }
        if (const std::string option = given_reading(reading_); !any_foreign && !option.empty())
            throw UserError(option + ": is for files of other programs, and none is compared");
        check_used();
        use_camera_file(camera_, request_.sets);
        if (!no_page_ && !request_.at && !film_.to_stdout) film_.page = page_of_comparison();
        if (request_.at) request_.sets = sets_for_still(std::move(request_.sets));
        CompareJob comparison(film_, reporter, read_comparison(request_, film_));
        return tell_folder(comparison.run(), film_);
    }

  private:
    // Refuses an option that has no effect, because all inputs are finished runs, or all are scenes to be
    // run. The inputs are files of scenes or folders of runs by now.
    void check_used() const {
        std::size_t runs = 0;
        for (const std::filesystem::path& input : request_.inputs) runs += is_folder(input) ? 1 : 0;
        if (no_cache_ && runs == request_.inputs.size())
            throw UserError("--no-cache: is for scenes that are run, and all of these are finished runs");
        if (!request_.replay && runs == 0)
            throw UserError("--no-replay: is for finished runs, and all of these are scenes to be run");
    }
    void add_vary(CLI::App& parser) {
        add_typed(parser, "--vary", request_.vary,
                  "Run one scene with two to six values of a key, as in --vary drive.g_level=2,4 or\n"
                  "--vary drive.frequency=\"20 Hz,30 Hz\"",
                  "KEY=VALUES");
    }
    void add_captions(CLI::App& parser) {
        add_typed(parser, "--captions", request_.captions,
                  "Caption of each panel, with bars between them, as in \"Γ = 1|Γ = 3\" [what differs: the "
                  "values of --vary, the drives, otherwise the titles]",
                  "TEXT");
    }

    CompareRequest request_;
    bool no_cache_ = false, no_page_ = false;
    CameraFiles camera_;
    ReadingOptions reading_;
    FilmRequest film_;
};

}  // namespace

std::unique_ptr<Verb> compare_verb() {
    return std::make_unique<Compare>();
}

}  // namespace grainreel
