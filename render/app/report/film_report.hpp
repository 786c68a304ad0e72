// What the verbs that make films say when they are done.
#pragma once

#include "render/run/film_run.hpp"

namespace grainreel {

// Prints where the run's files are, on stdout unless the film went there; gives the exit status.
int tell_folder(const FilmRun::Ended& ended, const FilmRequest& request);

}  // namespace grainreel
