// What the verbs that make films say when they are done.
#pragma once

#include "engine/run/folder/folder_run.hpp"
#include "render/film/sources/film_request.hpp"

namespace grainreel {

// Prints where the run's files are, on stdout unless the film went there; gives the exit status.
int tell_folder(const FolderRun::Ended& ended, const FilmRequest& request);

}  // namespace grainreel
