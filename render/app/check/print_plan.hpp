// Prints what `grainreel check` says: the plan of a scene, in chapters of lines about one subject.
// print_plan.cpp has the chapters about the experiment and about time steps, check_model.cpp those about the
// model, contacts and meshes, and check_cost.cpp those about files and cost.
#pragma once

#include <fmt/ostream.h>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/text.hpp"
#include "engine/plan/plan.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Prints the plan of a scene in words: what is modelled and what is left out, how it will be computed, what
// the results will be and what it will cost. The warnings of the plan and the film come last.
void print_plan(const FilmedScene& scene, const Plan& plan, std::ostream& out);

// The lines of the plan that are also true of a finished run. Each has a name and a text; the name is empty
// when the line continues the one before. `contacts` is the table of contacts, with its rows as lines.
struct PlanWords {
    std::vector<std::pair<std::string, std::string>> lines;
    std::string contacts;
};
PlanWords plan_words(const FilmedScene& scene, const Plan& plan);

// Prints lines of a name and a text, with all texts in one column, and keeps the lines.
class Listing {
  public:
    explicit Listing(std::ostream& out) : out_(out) {}
    void line(std::string_view name, const std::string& text) {
        fmt::print(out_, "{:<13}{}\n", name, message_text(text));
        lines_.emplace_back(name, text);
    }
    void gap() { out_ << '\n'; }
    const std::vector<std::pair<std::string, std::string>>& lines() const { return lines_; }

  private:
    std::ostream& out_;
    std::vector<std::pair<std::string, std::string>> lines_;
};

std::string metres_text(double metres);
std::string span_text(double seconds);
std::string grouped(std::int64_t count);  // 1234567 as "1,234,567"

std::string turn_text(const BodyTurn& turn);     // "turns at 30 rpm about ..."
std::string motion_text(const SceneMesh& mesh);  // "stands still"

// Prints three lines for each mesh, and one for each kind of fault that was mended.
void print_meshes(const Scene& scene, Listing& list);
void print_setup(const FilmedScene& scene, const Plan& plan, Listing& list);
void print_model(const FilmedScene& scene, const Plan& plan, Listing& list);
void print_contacts(const FilmedScene& scene, const Plan& plan, std::ostream& out);
void print_files(const FilmedScene& scene, const Plan& plan, const std::vector<SegmentCount>& film,
                 Listing& list);
// Prints the costs. The machine is measured when the cache has no figures of it (cost_estimate.hpp).
void print_cost(const FilmedScene& scene, const Plan& plan, const std::vector<SegmentCount>& film,
                Listing& list);

std::int64_t frames_of(const std::vector<SegmentCount>& film);

// What the film may fail to show, and the key that helps.
std::vector<std::string> film_hints(const FilmedScene& scene);

}  // namespace grainreel
