// The names of all files and folders that a run may write in its folder. A new file of runs must be added
// here, else --force refuses to replace the run.
#pragma once

#include <filesystem>

namespace grainreel {

// The frames that a run handed out while it went on, for a film's pictures for example, in the format of
// trajectory.nc. Frame k is the k-th of them.
inline constexpr const char* kFilmMoments = "film_moments.nc";
// The key moments of a run (engine/run/driver/agenda.hpp): grains in the format of trajectory.nc, contacts in
// that of contacts.nc. There `frame` counts the frames of key_moments.nc.
inline constexpr const char *kKeyMoments = "key_moments.nc", *kKeyContacts = "key_contacts.nc";

// A file in the folder of an imported run that says what was guessed and derived, a line for each.
inline constexpr const char* kImportNews = "import_news.txt";

// The page of a run.
inline constexpr const char* kPageName = "report.html";

// FormerFiles keeps a run as it was in .before. While it prepares or removes that folder, it is called
// .before.part.
inline constexpr const char *kFormerRun = ".before", *kFormerRunPart = ".before.part";

// The folder with the run in formats of other programs ([output] also).
inline constexpr const char* kAlsoFolder = "also";

// What is handed over to another engine has this file; a run of `--engine` has it in this folder.
inline constexpr const char *kHandoverFacts = "handover.toml", *kHandoverFolder = "handover";
// Whether another engine computed the run: a folder, or a file in one. Its dumps have grains alone, and no
// moment of it can be brought back.
bool is_of_another_engine(const std::filesystem::path& run);

bool is_file_of_runs(const std::filesystem::path& name);        // "movie.mp4"
bool is_folder_of_runs(const std::filesystem::path& name);      // "frames"
bool is_frame(const std::filesystem::path& name);               // "000123.png", in frames/
bool is_checkpoint_of_ring(const std::filesystem::path& name);  // "000000012345.grs", in checkpoints/
// Whether it is a file of also/ or of a folder there, by its ending. Unfinished files count.
bool is_in_also(const std::filesystem::path& name);

// Whether a run adds to the end of that file instead of replacing it.
bool grows(const std::filesystem::path& name);

// A run that is continued writes all of these. Throws UserError where one of them is a link, or not the file
// or folder that it should be, because writing through it might change any file.
void check_all_plain(const std::filesystem::path& run);

}  // namespace grainreel
