#pragma once
// What a run tells when it ends: the figures that one asks for first, in the units of the case.

#include "cases/program/fracture/case/fracture_case.h"
#include "cases/program/fracture/outcome/curve_units.h"
#include "cases/program/input/case_files/case_file.h"
#include "postproc/browser/browser_page.h"
#include "postproc/curves/summary.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pfdm {

/// "between 154.6 and 157.1 um, where the force goes from 10.58 to 9.23 N, at the lower pole; debonding angle 33
/// degrees", away from the poles "at polar angles of 40 to 70 degrees"; empty where the summary has none. Of a box
/// strains and stresses.
std::string first_debonding_words(const RunSummary& summary, const FractureCase& fracture, const CurveUnits& units);

/// Rows of a page's table, name and value in SI with prefixes: displacement and force on both sides of the first
/// debonding, and its angle; none where the summary has none.
std::vector<std::vector<std::string>> first_debonding_rows(const RunSummary& summary, const FractureCase& fracture);

/// A line each: greatest temperature rise, first debonding and what came off after it, greatest force, end of the
/// curve, laws of bands that were extracted into `results`.
std::vector<std::string> what_happened(const FractureCase& fracture, const CaseFile& file, const RunSummary& summary,
                                       const std::filesystem::path& results);

/// Largest normal traction and surface energy of the strongest law that was extracted into `results`, by their names in
/// summary.json; empty where there is none.
std::map<std::string, double> figures_of_laws(const std::filesystem::path& results);

/// Lines as sentences.
std::vector<std::string> as_sentences(std::vector<std::string> lines);

/// The same figures, each for itself: greatest temperature rise, first debonding, greatest force, laws, the run.
std::vector<HeadFigure> run_figures(const FractureCase& fracture, const CurveUnits& units, const RunSummary& summary,
                                    const std::filesystem::path& results);

}  // namespace pfdm
