// The names of all that a run may leave in its folder.
#pragma once

#include <filesystem>

namespace grainreel {

// Frames that a run handed out on its way, a film's pictures for one, in the format of trajectory.nc: frame k
// is the k-th of them.
inline constexpr const char* kFilmMoments = "film_moments.nc";
// Key moments of a run (engine/run/driver/agenda.hpp): grains in the format of trajectory.nc, contacts
// in that of contacts.nc, whose `frame` counts the frames of the former.
inline constexpr const char *kKeyMoments = "key_moments.nc", *kKeyContacts = "key_contacts.nc";

// Where FormerRun keeps what a run was, and where it makes that ready.
inline constexpr const char *kFormerRun = ".before", *kFormerRunPart = ".before.part";

// The run in formats of other programs ([output] also).
inline constexpr const char* kAlsoFolder = "also";

bool is_file_of_runs(const std::filesystem::path& name);        // "movie.mp4"
bool is_folder_of_runs(const std::filesystem::path& name);      // "frames"
bool is_frame(const std::filesystem::path& name);               // "000123.png", in frames/
bool is_checkpoint_of_ring(const std::filesystem::path& name);  // "000000012345.grs", in checkpoints/
// A file in also/ or in a folder there, by its ending; one that is not finished too.
bool is_in_also(const std::filesystem::path& name);

// Whether a run writes on at the end of that file, instead of putting another in its place.
bool grows(const std::filesystem::path& name);

// A run that goes on writes all of these. Throws UserError where one of them is a link, or no file or folder
// as it should be: what is written there might land anywhere.
void check_all_plain(const std::filesystem::path& run);

}  // namespace grainreel
