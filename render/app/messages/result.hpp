// Prints the results of the program: the folder that it made, a plan, figures, help. Results go to stdout;
// all else goes to stderr (reporter.hpp).
#pragma once

#include <string_view>

#include "engine/run/folder/folder_run.hpp"
#include "render/film/sources/film_request.hpp"

namespace grainreel {

// Prints a text of many lines. Control characters that came with a title or a name are made visible. A
// failure to write is remembered for close_results().
void print_result(std::string_view text);

// Prints text that scripts use as it is, the name of a folder or a command. Control characters are made
// visible on a terminal only.
void print_exact(std::string_view text);

// Opens what the program was started without of stdin, stdout and stderr (`>&-`), so that no file of a run
// gets the number of a stream, and messages are not written into it. What is printed on such a stdout fails
// in close_results(). To be called before anything is opened.
void open_missing_streams();

// To be called once, at the end. Throws RunError when some of what was printed did not get there. A reader
// that closes the pipe is no failure.
void close_results();

// Prints where the run's files are, on stdout unless the film went there; returns the exit status.
int tell_folder(const FolderRun::Ended& ended, const FilmRequest& request);

}  // namespace grainreel
