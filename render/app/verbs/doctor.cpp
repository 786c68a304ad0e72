// The verb `doctor`: what this machine has, what is missing, and how to get it.
#include <algorithm>

#include <fmt/format.h>

#include "render/app/doctor/findings.hpp"
#include "render/app/messages/result.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/report/version.hpp"
#include "render/app/verbs/verbs.hpp"

namespace grainreel {
namespace {

std::string line_of(const Finding& finding, std::size_t width) {
    const char* mark = finding.good ? "ok     " : finding.needed ? "MISSING" : "absent ";
    std::string line = fmt::format("{}  {:<{}}  {}\n", mark, finding.what, width, finding.state);
    if (!finding.good) line += fmt::format("{:{}}{}\n", "", 9 + width + 2, finding.remedy);
    return line;
}

class Doctor final : public Verb {
  public:
    Doctor()
        : Verb("doctor", "Tell what this machine has for films, what is missing, and how to get it",
               "Exit status: 0 films can be made, 1 something that they need is missing.") {}

    void add_options(CLI::App&) override {}

    int run(Reporter&) override {
        std::vector<Finding> all{{"program", where_program_is(), true, true, ""}};
        for (std::vector<Finding> found :
             {find_processors(), find_room(output_base()), find_drawing(), find_films(), find_letters(),
              find_programs(), find_imports(), find_packings()})
            all.insert(all.end(), found.begin(), found.end());
        std::size_t width = 0;
        for (const Finding& finding : all) width = std::max(width, finding.what.size());
        std::string text;
        for (const Finding& finding : all) text += line_of(finding, width);
        const bool films =
            std::all_of(all.begin(), all.end(), [](const Finding& one) { return one.good || !one.needed; });
        text += films ? "Films can be made here.\n"
                      : "Films cannot be made here before what is MISSING is there.\n";
        print_result(text);
        return films ? 0 : 1;
    }

    bool ends_in_good_order() const override { return false; }
};

}  // namespace

std::unique_ptr<Verb> doctor_verb() {
    return std::make_unique<Doctor>();
}

}  // namespace grainreel
