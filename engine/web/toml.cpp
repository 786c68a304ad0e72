// toml++, compiled once for the engine of a page.
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
