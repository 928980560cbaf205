#include "cases/program/input/config/expression.h"

#include "physics/error.h"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>
#include <mutex>
#include <numbers>

namespace pfdm {

// The parser keeps its variables by address, so one call at a time: boundary values are too few for this to matter.
struct Expression::Parsed {
  std::string text;
  std::mutex one_at_a_time;
  mu::Parser parser;
  double x = 0.0, y = 0.0, z = 0.0, t = 0.0;
};

Expression::Expression(const std::string& text) : parsed_(std::make_shared<Parsed>()) {
  parsed_->text = text;
  try {
    mu::Parser& parser = parsed_->parser;
    parser.DefineVar("x", &parsed_->x);
    parser.DefineVar("y", &parsed_->y);
    parser.DefineVar("z", &parsed_->z);
    parser.DefineVar("t", &parsed_->t);
    parser.DefineConst("pi", std::numbers::pi);
    parser.SetExpr(text);
    int n_results = 0;
    parser.Eval(n_results);
    if (n_results != 1) throw InputError(fmt::format("the expression \"{}\" is a list; expected one value", text));
  } catch (const mu::Parser::exception_type& error) {
    throw InputError(fmt::format("the expression \"{}\" cannot be read: {} It may use x, y, z (metres), t and pi", text,
                                 error.GetMsg()));
  }
}

double Expression::operator()(const Vector& x, double t) const {
  const std::lock_guard lock(parsed_->one_at_a_time);
  parsed_->x = x.x();
  parsed_->y = x.y();
  parsed_->z = x.z();
  parsed_->t = t;
  const double value = parsed_->parser.Eval();
  if (!std::isfinite(value))
    throw InputError(fmt::format("the expression \"{}\" is {} at x = {} m, y = {} m, z = {} m, t = {}", parsed_->text,
                                 value, x.x(), x.y(), x.z(), t));
  return value;
}

double evaluated(const std::string& text, const std::map<std::string, double>& variables) {
  try {
    mu::Parser parser;
    for (const auto& [name, value] : variables) parser.DefineConst(name, value);
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineFun("ceil", static_cast<double (*)(double)>(std::ceil));
    parser.DefineFun("floor", static_cast<double (*)(double)>(std::floor));
    parser.SetExpr(text);
    const double value = parser.Eval();
    if (!std::isfinite(value)) throw InputError(fmt::format("the expression \"{}\" is {}", text, value));
    return value;
  } catch (const mu::Parser::exception_type& error) {
    throw InputError(fmt::format("the expression \"{}\" cannot be read: {}", text, error.GetMsg()));
  }
}

bool Expression::uses_load() const {
  const std::lock_guard lock(parsed_->one_at_a_time);
  return parsed_->parser.GetUsedVar().contains("t");
}

}  // namespace pfdm
