// The chapters of a scene file: the code for one table each, such as [drive], or for a few that belong
// together. A chapter adds its keys to the list of all keys, reads them and writes them back. The chapters of
// [film] are in render/scene/keys. Internal to the reader and the writer of scenes. Comments such as "after
// species" say which chapters must have been read before.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/scene/keys/document.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/scene/text/toml_text.hpp"

namespace grainreel {

class TableReader;

namespace keys {
template <class T>
class KeyTable;
}

// Title and gravity, the keys that stand before the first table.
void list_top_level(keys::Keys& all);
void read_top_level(Document& document, Scene& scene);
void write_top_level(SceneText& out, const Scene& scene);

void list_species(keys::Keys& all);
void read_species(Document& document, Scene& scene, TableReader* further);
void write_species(SceneText& out, const Scene& scene);

// [contact] is written with the reasons for each stiffness.
void list_contact(keys::Keys& all);
void read_contact(Document& document, Scene& scene);  // after species and meshes
void write_contact(SceneText& out, const Scene& scene, const Reasons& reasons);
// The keys of one kind of contact, as [contact], [contact.wall] and [[contact.pair]] have them.
const keys::KeyTable<PairContact>& contact_table();
// Gives the tangential law that suits a normal law.
TangentialLaw suiting(NormalLaw law);

void list_container(keys::Keys& all);
void read_container(Document& document, Scene& scene);
void write_container(SceneText& out, const Scene& scene);

void list_meshes(keys::Keys& all);
void read_meshes(Document& document, Scene& scene);  // before contacts and container; loads their files
void write_meshes(SceneText& out, const Scene& scene);

void list_exits(keys::Keys& all);
void read_exits(Document& document, Scene& scene);
void write_exits(SceneText& out, const Scene& scene);

void list_walls(keys::Keys& all);
void read_walls(Document& document, Scene& scene);
void write_walls(SceneText& out, const Scene& scene);
void check_walls(const Scene& scene);  // throws UserError where a plane cannot be where it is

void list_grains(keys::Keys& all);
void read_grains(Document& document, Scene& scene);  // after species and feeds
void write_grains(SceneText& out, const Scene& scene);

void list_feeds(keys::Keys& all);
void read_feeds(Document& document, Scene& scene);  // after species and container
void count_fed(Document& document, Scene& scene);   // how many grains feeds give; after the run
void write_feeds(SceneText& out, const Scene& scene);

void list_drive(keys::Keys& all);
void read_drive(Document& document, Scene& scene);  // after gravity
void write_drive(SceneText& out, const Scene& scene);

void list_start(keys::Keys& all);
void read_start(Document& document, Scene& scene);  // after container and grains
void write_start(SceneText& out, const Scene& scene);

// [run] and [output] are written with the reason for the step.
void list_run(keys::Keys& all);
void read_run(Document& document, Scene& scene);  // after the contacts
void write_run(SceneText& out, const Scene& scene, const Reasons& reasons);

// [output.fields].
void list_fields(keys::Keys& all);
void read_fields(Document& document, Scene& scene);  // after drive and run, and the count of fed grains
void write_fields(SceneText& out, const Scene& scene);

// Finds the box in which each mesh moves. To be called when all keys have been read.
void measure_meshes(Scene& scene);

// Gives a scene without a container the size of the box around all that it holds. To be called after
// measure_meshes().
void size_empty_space(Scene& scene);

// Checks keys against each other: keys that are allowed alone may be wrong together. Throws UserError.
void check_scene(const Scene& scene);
void check_meshes(const Scene& scene);  // the same for meshes, exits and turning containers

// Warnings of likely slips in a mesh's size, as lines for the user.
std::vector<std::string> doubts_of_meshes(const Scene& scene);

// Whether a species of this number and name comes from a feed; for use before the feeds are read.
bool is_fed(Document& document, std::size_t number, const std::string& name);

// The species that a key names, or the first one. Throws UserError where there is none of that name.
std::size_t species_named(Document& document, const Scene& scene, const std::string& path);

// Makes a direction a unit vector. Throws UserError where it is zero.
void make_unit(const Document& document, const std::string& path, Vec3& direction);

// Throws UserError where the box of a table with 'low' and 'high' has no room.
void check_corners(const Document& document, const std::string& table, const Vec3& low, const Vec3& high);

// Reads tables that the engine keeps only as text, such as [film]. It reads them from the same document, so
// messages name lines, and the first mistake in the file is reported first.
class TableReader {
  public:
    virtual ~TableReader() = default;

    // All keys that the file may have, including the engine's.
    virtual const std::vector<Key>& keys() const = 0;
    // Reads what one species has for this reader. The engine has read that species.
    virtual void read_species(Document& document, std::size_t species) = 0;
    // Reads the tables of this reader. The engine has read all of its own.
    virtual void read_tables(Document& document) = 0;
    // Checks keys against each other, like check_scene(). Throws UserError.
    virtual void check() const = 0;
};

}  // namespace grainreel
