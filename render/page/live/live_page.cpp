#include "render/page/live/live_page.hpp"

#include <fmt/format.h>

#include "render/page/embed.hpp"
#include "render/page/facts/page_facts.hpp"
#include "render/page/page_files.hpp"
#include "render/page/page_parts.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

std::string live_page(const FilmedScene& scene, const std::filesystem::path& folder,
                      const std::optional<PlannedScene>& planned) {
    const RunFacts record = run_facts(folder);
    const PageFiles& files = page_files();
    const std::string picture =
        "<img id=\"live-picture\" class=\"poster\" alt=\"The film's newest picture: grains in their "
        "container, with "
        "time and scale beside them\" hidden>\n";
    const std::string bed = filled(
        files.bed, {{"about",
                     "The newest moment that the run has written. Places are rounded to 16 bits over the box "
                     "that the grains reach."},
                    {"n", ""}});
    const std::string body = filled(
        files.body,
        {{"film", picture}, {"bed", bed}, {"fields", ""}, {"charts", filled(files.charts, {{"about", ""}})}});
    return filled(files.page, {{"title", html_text(scene.title.empty() ? scene.name : scene.title)},
                               {"body_class", ""},
                               {"style", std::string(files.style)},
                               {"lead", lead_html(scene)},
                               {"live", std::string(files.live)},
                               {"body", body},
                               {"words", chapters_html(scene, record, planned, folder, "report.html")},
                               {"facts", json_in_html(live_facts_json(scene))},
                               {"script", files.script(!scene.meshes.empty())},
                               {"blobs", ""}});
}

std::string waiting_page(const std::string& title) {
    const std::string text = html_text(title);
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\">\n<meta http-equiv=\"refresh\" "
        "content=\"1\">\n<link rel=\"icon\" href=\"data:,\">\n<title>{0}"
        "</title>\n</head>\n<body>\n<h1>{0}</h1>\n<p>The run begins.</p>\n</body>\n</html>\n",
        text);
}

}  // namespace grainreel
