// The words of pages that compute, beside those of page_words_table.hpp.
#pragma once

#include "render/page/page_words_table.hpp"

namespace grainreel {

inline constexpr auto play_rows = std::to_array<PageRow>({
    {"This page computes the bed by a script, and scripts are switched off here.",
     {"Diese Seite rechnet die Schüttung mit einem Skript, und Skripte sind hier abgeschaltet.",
      "Cette page calcule le lit de grains par un script, et les scripts sont désactivés ici.",
      "Esta página calcula el lecho con un script, y aquí los scripts están desactivados."}},
    {"The engine is being unpacked.",
     {"Der Rechenkern wird ausgepackt.", "Le moteur de calcul est décompressé.",
      "Se está desempaquetando el motor de cálculo."}},
    {"How far the packing is",
     {"Wie weit das Packen ist", "Où en est la mise en place", "Cómo va el empaquetado"}},
    // What is done with the bed.
    {"Shake", {"Schütteln", "Secouer", "Agitar"}},
    {"Go on", {"Weiter", "Continuer", "Seguir"}},
    {"One period", {"Eine Periode", "Une période", "Un periodo"}},
    {"Speed", {"Tempo", "Vitesse", "Ritmo"}},
    {"as in life", {"wie in echt", "comme en vrai", "como en la realidad"}},
    {"4 times slower", {"4-mal langsamer", "4 fois plus lent", "4 veces más lento"}},
    {"10 times slower", {"10-mal langsamer", "10 fois plus lent", "10 veces más lento"}},
    {"50 times slower", {"50-mal langsamer", "50 fois plus lent", "50 veces más lento"}},
    {"as fast as it can", {"so schnell es geht", "aussi vite que possible", "lo más rápido posible"}},
    {"Start again", {"Von vorn", "Recommencer", "Empezar de nuevo"}},
    {"Stop shaking", {"Nicht schütteln", "Ne plus secouer", "Dejar de agitar"}},
    {"Shake again", {"Wieder schütteln", "Secouer à nouveau", "Volver a agitar"}},
    {"Tap once", {"Einmal klopfen", "Un coup", "Un golpe"}},
    {"Tilt", {"Neigung", "Inclinaison", "Inclinación"}},
    {"Packs anew", {"Packt neu", "Remet en place", "Empaqueta de nuevo"}},
    {"Pack with these", {"Damit packen", "Remplir ainsi", "Empaquetar así"}},
    {"Half as many grains", {"Halb so viele Körner", "Moitié moins de grains", "La mitad de granos"}},
    {"Take this along", {"Mitnehmen", "Emporter", "Llevárselo"}},
    {"A scene file with the knobs as they stand, for a film.",
     {"Eine Szenendatei mit den Reglern, wie sie stehen, für einen Film.",
      "Un fichier de scène avec les réglages actuels, pour un film.",
      "Un archivo de escena con los mandos como están, para una película."}},
    {"{1} is saved. Make its film by: {2}",
     {"{1} ist gespeichert. Den Film macht: {2}", "{1} est enregistré. Pour en faire un film : {2}",
      "{1} está guardado. Su película se hace con: {2}"}},
    // Knobs.
    {"frequency of shaking",
     {"Frequenz des Schüttelns", "fréquence des secousses", "frecuencia de agitación"}},
    {"Γ, its acceleration over gravity",
     {"Γ, Beschleunigung durch Schwere", "Γ, accélération sur pesanteur", "Γ, aceleración entre gravedad"}},
    {"friction between grains",
     {"Reibung zwischen Körnern", "frottement entre grains", "rozamiento entre granos"}},
    {"friction at walls", {"Reibung an Wänden", "frottement aux parois", "rozamiento en las paredes"}},
    {"bounciness (restitution)",
     {"Sprungkraft (Restitution)", "rebond (restitution)", "rebote (restitución)"}},
    {"bounciness at walls", {"Sprungkraft an Wänden", "rebond aux parois", "rebote en las paredes"}},
    {"gravity", {"Schwere", "pesanteur", "gravedad"}},
    {"another throw of the grains (seed)",
     {"anderer Wurf der Körner (Seed)", "autre tirage des grains (graine)",
      "otra tirada de los granos (semilla)"}},
    {"number of {1}", {"Anzahl {1}", "nombre de {1}", "número de {1}"}},
    {"diameter of {1}", {"Durchmesser {1}", "diamètre de {1}", "diámetro de {1}"}},
    {"{1}: known values", {"{1}: bekannte Werte", "{1} : valeurs connues", "{1}: valores conocidos"}},
    {"Moon", {"Mond", "Lune", "Luna"}},
    {"Mars", {"Mars", "Mars", "Marte"}},
    {"Earth", {"Erde", "Terre", "Tierra"}},
    // What the page says while it computes.
    {"The grains grow to their sizes",
     {"Die Körner wachsen zu ihrer Größe", "Les grains grandissent", "Los granos crecen hasta su tamaño"}},
    {"The grains rain", {"Die Körner regnen", "Les grains tombent en pluie", "Los granos llueven"}},
    {"The bed settles", {"Die Schüttung setzt sich", "Le lit se dépose", "El lecho se asienta"}},
    {"{1} s since the drive began.",
     {"{1} s seit Beginn des Antriebs.", "{1} s depuis le début de l’excitation.",
      "{1} s desde que empezó la excitación."}},
    {"{1} s of the bed; {2} s of it in a second.",
     {"{1} s der Schüttung; {2} s davon in einer Sekunde.", "{1} s du lit ; {2} s par seconde.",
      "{1} s del lecho; {2} s en cada segundo."}},
    {"This device computes {1} s of the bed in a second, not {2}. Fewer grains are faster, or a lower speed.",
     {"Dieses Gerät rechnet {1} s der Schüttung in einer Sekunde, nicht {2}. Weniger Körner gehen schneller, "
      "oder "
      "ein langsameres Tempo.",
      "Cet appareil calcule {1} s du lit par seconde, et non {2}. Moins de grains vont plus vite, ou une "
      "vitesse "
      "plus basse.",
      "Este aparato calcula {1} s del lecho por segundo, no {2}. Menos granos van más rápido, o un ritmo más "
      "lento."}},
    {"The scene ends here, at {1} s.",
     {"Hier endet die Szene, bei {1} s.", "La scène se termine ici, à {1} s.",
      "La escena termina aquí, a los {1} s."}},
    {"It does not go on: {1}", {"Es geht nicht weiter: {1}", "Cela ne continue pas : {1}", "No sigue: {1}"}},
    {"this browser has no WebAssembly, or it is switched off",
     {"dieser Browser hat kein WebAssembly, oder es ist abgeschaltet",
      "ce navigateur n’a pas WebAssembly, ou il est désactivé",
      "este navegador no tiene WebAssembly, o está desactivado"}},
    {"this browser is too old for the engine (it needs WebAssembly with SIMD and exceptions)",
     {"dieser Browser ist zu alt für den Rechenkern (er braucht WebAssembly mit SIMD und Ausnahmen)",
      "ce navigateur est trop ancien pour le moteur (il faut WebAssembly avec SIMD et exceptions)",
      "este navegador es demasiado antiguo para el motor (necesita WebAssembly con SIMD y excepciones)"}},
    // What is computed.
    {"What is computed", {"Was gerechnet wird", "Ce qui est calculé", "Qué se calcula"}},
    {"This page has the engine of grainreel in it, compiled for browsers, and computes every contact of "
     "every "
     "grain. Nothing is sent anywhere.",
     {"Diese Seite hat den Rechenkern von grainreel in sich, für Browser übersetzt, und rechnet jeden "
      "Kontakt "
      "jedes Korns. Nichts wird irgendwohin gesendet.",
      "Cette page contient le moteur de grainreel, compilé pour les navigateurs, et calcule chaque contact "
      "de "
      "chaque grain. Rien n’est envoyé nulle part.",
      "Esta página lleva dentro el motor de grainreel, compilado para navegadores, y calcula cada contacto "
      "de "
      "cada grano. Nada se envía a ninguna parte."}},
    {"To be quick, its grains are softer than those of a film: that is the only thing that differs.",
     {"Damit es schnell geht, sind ihre Körner weicher als die eines Films; sonst ist nichts anders.",
      "Pour aller vite, ses grains sont plus mous que ceux d’un film : c’est la seule différence.",
      "Para ir rápido, sus granos son más blandos que los de una película: es lo único que difiere."}},
    {"Its grains are as stiff as the scene asks for.",
     {"Ihre Körner sind so steif, wie die Szene es verlangt.",
      "Ses grains sont aussi raides que le demande la scène.",
      "Sus granos son tan rígidos como pide la escena."}},
    {"Grains overlap by {1} % of their diameter at most, by the plan; one step is {2} µs.",
     {"Körner überlappen nach Plan um höchstens {1} % ihres Durchmessers; ein Schritt ist {2} µs.",
      "Les grains se recouvrent d’au plus {1} % de leur diamètre, selon le plan ; un pas dure {2} µs.",
      "Los granos se solapan como mucho un {1} % de su diámetro, según el plan; un paso dura {2} µs."}},
});

}  // namespace grainreel
