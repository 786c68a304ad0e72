// The words that scenes use for choices. The reader, the writer and the list of keys take them from here.
#pragma once

#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

inline const ChoiceWords<NormalLaw> normal_law_words{{"walton-braun", NormalLaw::walton_braun},
                                                     {"spring-dashpot", NormalLaw::spring_dashpot},
                                                     {"hertz", NormalLaw::hertz}};
inline const ChoiceWords<TangentialLaw> tangential_law_words{
    {"incremental-slip", TangentialLaw::incremental_slip},
    {"linear-spring", TangentialLaw::linear_spring},
    {"mindlin", TangentialLaw::mindlin},
    {"none", TangentialLaw::none}};
inline const ChoiceWords<Integrator> integrator_words{{"velocity-verlet", Integrator::velocity_verlet},
                                                      {"leapfrog", Integrator::leapfrog},
                                                      {"position-verlet", Integrator::position_verlet},
                                                      {"forest-ruth", Integrator::forest_ruth},
                                                      {"gear", Integrator::gear}};
inline const ChoiceWords<Precision> precision_words{{"double", Precision::full}, {"mixed", Precision::mixed}};
inline const ChoiceWords<Accuracy> accuracy_words{
    {"draft", Accuracy::draft}, {"standard", Accuracy::standard}, {"reference", Accuracy::reference}};

inline const ChoiceWords<FieldOutput::Grid> field_grid_words{
    {"none", FieldOutput::Grid::none}, {"yz", FieldOutput::Grid::yz}, {"xyz", FieldOutput::Grid::xyz}};
inline const ChoiceWords<FieldOutput::Kernel> field_kernel_words{{"gaussian", FieldOutput::Kernel::gaussian},
                                                                 {"lucy", FieldOutput::Kernel::lucy}};

}  // namespace grainreel
