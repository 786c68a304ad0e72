// The verb `export` writes frames of a run, of ours or of another program, in another program's format.
#include <filesystem>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/scene/text/units.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/options/run_to_read.hpp"
#include "render/app/verbs/verbs.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

std::string about_formats() {
    std::string text = "Formats:\n";
    for (const WriteFormat& format : frame_formats())
        text += fmt::format("  {:<14}{}\n", format.name, format.about);
    return text;
}

class Export final : public Verb {
  public:
    Export()
        : Verb("export", "Write a run's frames for another program",
               "RUN is a run of ours, or files of another program, so this is a converter too. The file or "
               "folder that "
               "was made goes to stdout.\n\n" +
                   about_formats() + exit_statuses) {}

    void add_options(CLI::App& parser) override {
        parser
            .add_option("RUN", run_,
                        "Folder of a run, or files of another program: a file, a quoted pattern, a folder")
            ->required()
            ->type_name("PATH");
        std::vector<std::string> names;
        for (const WriteFormat& format : frame_formats()) names.emplace_back(format.name);
        parser.add_option("--to", format_, "Format of the files; see below")
            ->required()
            ->type_name("FORMAT")
            ->check(CLI::IsMember(names));
        parser
            .add_option("--out", out_,
                        "File or folder to make [beside RUN, with its name and the ending of the format; "
                        "when that is taken, "
                        "with a number, as in RUN.2.xyz]")
            ->type_name("PATH")
            ->check(not_empty());
        parser.add_flag("--force", force_, "Replace a file or folder of that name");
        CLI::Option* at =
            add_time(parser, "--at", choice_.at, "Write only this moment, or the kept one nearest to it");
        CLI::Option* from =
            add_time(parser, "--from", choice_.from, "First moment to write [the run's first]");
        CLI::Option* until =
            add_time(parser, "--until", choice_.until, "Last moment to write [the run's last]");
        CLI::Option* every = parser.add_option("--every", choice_.every, "Write every Nth frame [1]")
                                 ->check(CLI::Range(std::int64_t{1}, std::int64_t{1000000000}))
                                 ->type_name("N");
        for (CLI::Option* other : {from, until, every}) at->excludes(other);
        add_reading(parser, reading_);
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        check_reading(run_, reading_);
        if (!is_foreign(run_)) refuse_other_folder(run_);
        if (!out_.empty()) check_free(out_, force_);
        bring_back_to_read(run_, reporter);
        StoredRunRequest request;
        request.reading = reading_;
        const StoredRun run(run_, request);
        for (const std::string& line : run.all_news()) reporter.info(line);
        const ShareWatcher watcher(reporter, Progress::Stage::exporting);
        const Exported made = export_frames(run, format_, out_.empty() ? usual_name() : out_, choice_, force_,
                                            [&](double done) { return watcher(format_, done); });
        if (choice_.at && !made.is_asked)
            reporter.info(
                fmt::format("--at: {:.6g} s was not kept; {:.6g} s is written, the kept moment that "
                            "is nearest",
                            *choice_.at, made.first));
        for (const std::string& line : made.news) reporter.info(line);
        reporter.info(fmt::format("wrote {}: {}, {}", made.path.string(), counted(made.frames, "frame"),
                                  data_size_text(static_cast<double>(made.bytes))));
        print_exact(made.path.string() + "\n");
        return 0;
    }

    bool ends_in_good_order() const override { return false; }

  private:
    // The usual name of the result: "run.dump"; for vtk the folder "run-vtk"; for xyz "run.xyz". When a name
    // is taken, a number is added after a point: "run.2.xyz", "run.2-vtk", unless --force replaces what is
    // there. Runs have theirs after a hyphen, so that "run-2.xyz" is of the run "run-2" alone.
    fs::path usual_name() const {
        std::string ending;
        for (const WriteFormat& format : frame_formats())
            if (format_ == format.name) ending = format.ending;
        fs::path base = fs::absolute(run_).lexically_normal();
        if (!base.has_filename()) base = base.parent_path();
        const bool folder = is_folder(base);  // its name has no ending
        std::string stem = (folder ? base.filename() : base.stem()).string();
        std::erase_if(stem, [](char c) { return c == '*' || c == '?' || c == '[' || c == ']'; });
        const fs::path beside =
            run_.has_parent_path() && run_.has_filename() ? run_.parent_path() : base.parent_path();
        fs::path name = beside / (stem + ending);
        for (int number = 2; is_there(name) && !force_; ++number)
            name = beside / fmt::format("{}.{}{}", stem, number, ending);
        return name;
    }

    fs::path run_, out_;
    std::string format_;
    ExportChoice choice_;
    ReadingOptions reading_;
    bool force_ = false;
};

}  // namespace

std::unique_ptr<Verb> export_verb() {
    return std::make_unique<Export>();
}

}  // namespace grainreel
