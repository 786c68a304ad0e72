#include "render/app/verbs/verbs.hpp"

// The table, in the order of --help: NAME stands for the function NAME_verb() of the file NAME.cpp.
#define GRAINREEL_VERBS(verb)                                                                               \
    verb(movie) verb(resume) verb(render) verb(join) verb(compare) verb(report) verb(export) verb(handover) \
        verb(watch) verb(inspect) verb(study) verb(check) verb(new) verb(scenes) verb(schema) verb(doctor)  \
            verb(chart) verb(bench) verb(completion) verb(manual)

namespace grainreel {

#define GRAINREEL_DECLARE(name) std::unique_ptr<Verb> name##_verb();
GRAINREEL_VERBS(GRAINREEL_DECLARE)

std::vector<std::unique_ptr<Verb>> all_verbs() {
    std::vector<std::unique_ptr<Verb>> all;
#define GRAINREEL_ADD(name) all.push_back(name##_verb());
    GRAINREEL_VERBS(GRAINREEL_ADD)
    return all;
}

}  // namespace grainreel
