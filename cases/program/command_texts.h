#pragma once
// What pfdm help says of each command.

#include <string_view>

namespace pfdm {

inline constexpr const char* exit_statuses =
    "Exit status: 0 done; 1 the computation failed; 2 the input is wrong;\n"
    "130 or 143 interrupted (Ctrl-C, SIGTERM).";

/// A command, with what it writes and where.
struct CommandText {
  const char* name;
  const char* description;
  const char* writes;
};

/// Commands that take a case.
inline constexpr CommandText case_commands[] = {
    {"run", "Run a case: make the mesh, solve, write the results",
     "Writes to CASE/results: summary.json, run.log, case.toml (as it ran) and, by kind of case,\n"
     "  fracture       force_displacement.csv, fields.pvd (ParaView), mesh.vtu, cohesive laws\n  endochronic    "
     "history.csv\n  mass_material  a CSV file for "
     "each test\nA fracture run that was killed or interrupted continues with --restart."},
    {"check", "Read everything and solve nothing: say what would run, or what is wrong", "Writes no files."},
    {"mesh", "Make the mesh and measure its quality", "Writes CASE/results/mesh.vtu."},
    {"cohesive", "Extract the traction-separation laws of interfaces and planes from the results of a run",
     "Writes to CASE/results: cohesive.json, cohesive_law.csv, cohesive_law_places.csv and,\n"
     "around particles, debonding.csv. With --export one law as input of other codes, in\n"
     "CASE/results/cohesive_law: abaqus.inp, moose.i, lsdyna.k, optistruct.fem, akantu.dat, solids4foam,\n"
     "table.csv. Their heads say what each figure rests on."},
    {"compare", "Compare the results of a run with the experiment that the case names in [experiment]",
     "Writes to CASE/results: comparison.json, comparison.csv."},
    {"reduce", "Reduce the records of a fracture test to energy release rates, as the standards of its specimen do",
     "Needs no run. Writes to CASE/results: reduction.json (methods, corrections, G at initiation and in propagation,\n"
     "beside the toughness of a fit) and reduction.csv (G and crack length by point)."},
    {"fit", "Estimate the values that the case names in [fit] from its experiment",
     "Writes to CASE/results: fit.json, the fitted case case.fitted.toml and curves. The last line is the\nverdict: "
     "sound (with correlated residuals, within the error of mesh and steps), questionable or failed;\n"
     "estimates of a fit that is not sound have no intervals. The fit of a fracture "
     "case keeps "
     "its runs in CASE/results/runs; the same command continues them."},
    {"sweep", "Run a case with the sets of values that it names in [sweep]",
     "Writes to CASE/results: sweep.csv, a row for each run. The runs are kept in CASE/results/runs, with links by\n"
     "their values in runs_by_value; the same command continues them. pfdm report CASE then draws the figures."},
    {"sensitivity", "Say which parameter of a case moves which part of its force-displacement curve",
     "Writes to CASE/results: sensitivity.json, sensitivity.csv (elasticities d ln F/d ln p over the displacement, "
     "with\n"
     "errors) and the page sensitivity/index.html. By differences each parameter takes four runs, which are kept in\n"
     "CASE/results/runs; the same command continues them. --method direct takes one run, and keeps nothing on the "
     "way."},
    {"analyse", "Analyse the vibration records of a case without a fit: spectra, responses, harmonics",
     "Writes to CASE/results/analysis: analysis.json and, of each test NAME, NAME_spectra.csv (densities, H1, H2, Hv,\n"
     "coherence with bounds), NAME_spectrogram.csv and, of sines, NAME_harmonics.csv, NAME_envelopes.csv (recorded,\n"
     "and of the models of the case and of its fits). pfdm report then draws a page of each test."},
    {"report", "Draw pictures and plots of the results on one page",
     "Writes to CASE/results/report: report.pdf, report.png and index.html, a page that a browser opens without\n"
     "network; after analyse a folder NAME with these of each test; of a sweep its figures against the values. CASE\n"
     "may be the folder of results too, as that of a run of a sweep.\n"
     "Of several cases or folders of results, pfdm report A B C, one page sets the runs side by side: curves over "
     "each\n"
     "other, figures and keys that differ in tables, bodies in step. It goes to comparison/index.html here, or to\n"
     "index.html in the folder that --output names, which must be empty or hold an earlier comparison."},
};

inline constexpr CommandText other_commands[] = {
    {"init", "Make a new case directory from an existing case, or of a standard specimen and its test",
     "Writes to DIR: case.toml, the data files that it names, a README.md to be filled in; no results.\n"
     "Without --like it lists the cases to choose from; --specimen alone lists the specimens."},
    {"list", "List the cases that ship: name, kind, what a run here has taken, title", "Writes no files."},
    {"help", "Say what a command does, as COMMAND --help, or what a key of case.toml is", "Writes no files."},
    {"completion", "Print a script that completes words in bash or zsh",
     "bash: put it where your shell reads it, as in\n"
     "  pfdm completion bash > ~/.local/share/bash-completion/completions/pfdm\n"
     "zsh: in ~/.zshrc, after compinit:  source <(pfdm completion zsh)"},
    {"test", "Run the project's tests (through the launcher, ./pfdm test)",
     "The tests write to a temporary directory."},
};

/// "" for what is no command.
inline const char* writes_of(std::string_view command) {
  for (const CommandText& text : case_commands)
    if (text.name == command) return text.writes;
  for (const CommandText& text : other_commands)
    if (text.name == command) return text.writes;
  return "";
}

}  // namespace pfdm
