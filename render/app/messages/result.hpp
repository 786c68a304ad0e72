// What the program prints as its result: the folder that it made, a plan, figures, help. Results go to
// stdout; all else goes to stderr (reporter.hpp).
#pragma once

#include <string_view>

#include "engine/run/folder/folder_run.hpp"
#include "render/film/sources/film_request.hpp"

namespace grainreel {

// Text of many lines. Control characters that a title or a name brought along are written out (visible).
// Keeps in mind when it cannot be written.
void print_result(std::string_view text);

// What a script takes as it is, the name of a folder or a command: written out on a terminal only.
void print_exact(std::string_view text);

// To be called once, at the end. Throws RunError when some of what was printed did not get there. A reader
// that has closed the pipe wants no more, which is no failure.
void close_results();

// Prints where the run's files are, on stdout unless the film went there; gives the exit status.
int tell_folder(const FolderRun::Ended& ended, const FilmRequest& request);

}  // namespace grainreel
