#include "cases/program/chain/chain_case.h"

namespace pfdm {
namespace {

const KeyTable& figure_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "step[].figures[]",
      .sentence = "A number of a step's results that the chain's page shows.",
      .keys = {
          {"says", text("words"), "", "What the number is, in words."},
          {"file", text("name of a file"), "\"summary.json\", of a fit \"fit.json\"",
           "File of the step's results with the number."},
          {"key", text("key"), "",
           "Where the number is in the file: names with dots between, as in numbers from results."},
          {"unit", text("unit"), "none", "Unit of the number, for the page."},
          {"interval", list(text("key"), 2, 2), "none", "Keys of the lower and upper end of the number's interval."}}};
  return table;
}

const KeyTable& step_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "step[]",
      .sentence = "A job of another case.",
      .keys = {{"name", text("name"), "the path", "What the step is called."},
               {"case", path(), "", "Case directory of the step, or a .toml file in one, seen from the chain's."},
               {"outside", flag(), "false",
                "Whether the step's case, and with it its results, may lie outside of the chain's folder."},
               {"does", one_of("job of a step", chain_jobs()), "\"run\"", "What the step does: run or fit."},
               {"accept", choice("verdict with which a chain goes on", {"sound", "questionable"}), "\"sound\"",
                "Worst verdict on a fit with which the chain goes on."},
               {"figures", tables(figure_keys), "none", "Numbers of the step's results that the page shows."}}};
  return table;
}

}  // namespace

const KeyTable& chain_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "kind \"chain\"",
      .sentence = "Jobs of other cases one after the other, which take numbers from each other's results.",
      .keys =
          joined({head_keys(),
                  {{"step", tables(step_keys), "", "Steps of the chain, one after the other."},
                   {"sweep", anything(), "refused", "A chain has no sweep: the cases of its steps may have one."}}})};
  return table;
}

}  // namespace pfdm
