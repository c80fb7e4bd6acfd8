#include "app/figures/family_checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "app/ranks/on_all_ranks.h"
#include "app/run/model_checkpoint.h"
#include "app/run/resumed_checkpoint.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

using mechanics::ClassStability, mechanics::FigureFamily, mechanics::FigureMember, mechanics::LinearStability;

/// A list of numbers, to which an object appends its members, or from which it takes them. `transfer` below describes
/// the order of the members for both directions.
class NumberList {
 public:
  /// An empty list, to which objects append their members.
  NumberList() = default;
  /// A list from which objects take their members. `origin` is the file of the list, for messages.
  NumberList(std::vector<double> values, std::string origin)
      : takes_(true), values_(std::move(values)), origin_(std::move(origin)) {}

  void transfer(double& x) {
    if (!takes_) return values_.push_back(x);
    if (n_taken_ == values_.size()) throw UserError("the checkpoint " + origin_ + " ends within a figure");
    x = values_[n_taken_++];
  }
  template <class Number>
  void transfer_as_double(Number& x) {
    double value = static_cast<double>(x);
    transfer(value);
    x = static_cast<Number>(value);
  }
  void transfer(Eigen::VectorXd& x) {
    x.resize(size(x.size()));
    for (double& entry : x) transfer(entry);
  }
  template <class T, class Transfer>
  void transfer(std::vector<T>& list, const Transfer& transfer_entry) {
    list.resize(static_cast<std::size_t>(size(static_cast<Eigen::Index>(list.size()))));
    for (T& entry : list) transfer_entry(entry);
  }
  std::vector<double> values() && { return std::move(values_); }

 private:
  /// The length of a list that follows: `present` if the list is appended.
  Eigen::Index size(Eigen::Index present) {
    transfer_as_double(present);
    const auto n_left = static_cast<Eigen::Index>(values_.size() - n_taken_);
    if (takes_ && (present < 0 || present > n_left))
      throw UserError("the checkpoint " + origin_ + " ends within a list");
    return present;
  }

  bool takes_ = false;
  std::vector<double> values_;
  std::string origin_;
  std::size_t n_taken_ = 0;
};

void transfer(NumberList& numbers, mechanics::MotionClass& motions) {
  numbers.transfer_as_double(motions.odd_in_z);
  numbers.transfer_as_double(motions.m);
}

void transfer(NumberList& numbers, LinearStability& stability) {
  numbers.transfer(stability.rates, [&](mechanics::Rate& rate) {
    double re = rate.s.real(), im = rate.s.imag();
    numbers.transfer(re);
    numbers.transfer(im);
    rate.s = {re, im};
    numbers.transfer_as_double(rate.energy_sign);
  });
  numbers.transfer(stability.second_variation);
  numbers.transfer_as_double(stability.n_negative);
  numbers.transfer(stability.growth_rate);
  numbers.transfer_as_double(stability.stable);
}

void transfer(NumberList& numbers, FigureMember& member) {
  numbers.transfer(member.parameter);
  numbers.transfer(member.figure.x);
  numbers.transfer(member.figure.lambda);
  numbers.transfer(member.figure.drive);
  numbers.transfer(member.figure.residual);
  numbers.transfer(member.classes, [&](ClassStability& of_class) {
    transfer(numbers, of_class.motions);
    transfer(numbers, of_class.stability);
    transfer(numbers, of_class.in_smaller_basis);
  });
}

/// All of the family except the reasons of missing members, which are texts.
void transfer(NumberList& numbers, FigureFamily& family) {
  numbers.transfer(family.members, [&](FigureMember& member) { transfer(numbers, member); });
  numbers.transfer(family.special, [&](mechanics::SpecialFigure& special) {
    numbers.transfer_as_double(special.kind);
    transfer(numbers, special.motions);
    transfer(numbers, special.member);
  });
  numbers.transfer(family.missing, [&](mechanics::NoFigure& missing) { numbers.transfer(missing.parameter); });
  numbers.transfer(family.without_special, [&](double& parameter) { numbers.transfer(parameter); });
}

constexpr const char* of_table = "table";
std::string name_of_numbers(std::size_t k) { return fmt::format("family {}", k); }
std::string name_of_reason(std::size_t k, std::size_t i) { return fmt::format("family {}: reason {}", k, i); }

}  // namespace

FamilyCheckpoint::FamilyCheckpoint(const RunContext& context, std::string name)
    : context_(context), name_(std::move(name)), keeps_states_(!context.tables || !context.ranks->is_first()) {
  if (!keeps_states_) return;
  auto earlier = resumed_checkpoint(context, name_);
  on_all_ranks(*context.ranks, [&] {
    if (earlier && earlier->get_string(of_table) != name_)
      throw UserError(path().string() + " is the checkpoint of another model");
    if (earlier) content_ = std::move(*earlier);
    content_.set("scene", run_identity(context.scene).frozen_scene);
    content_.set(of_table, name_);
  });
}

FigureFamily FamilyCheckpoint::known(std::size_t k) const {
  FigureFamily family;
  if (!content_.has(name_of_numbers(k))) return family;
  NumberList numbers(content_.get_doubles(name_of_numbers(k)), path().string());
  transfer(numbers, family);
  for (std::size_t i = 0; i < family.missing.size(); ++i)
    family.missing[i].reason = content_.get_string(name_of_reason(k, i));
  return family;
}

void FamilyCheckpoint::save(std::size_t k, const FigureFamily& known) {
  on_all_ranks(*context_.ranks, [&] {
    if (!keeps_states_ || !context_.ranks->is_first()) return;
    const auto start = Clock::now();
    NumberList numbers;
    FigureFamily copy = known;
    transfer(numbers, copy);
    content_.set(name_of_numbers(k), std::move(numbers).values());
    for (std::size_t i = 0; i < known.missing.size(); ++i) content_.set(name_of_reason(k, i), known.missing[i].reason);
    content_.save(path());
    last_save_ = Clock::now();
    cost_ = last_save_ - start;
  });
}

void FamilyCheckpoint::save_if_old(std::size_t k, const FigureFamily& known) {
  constexpr std::chrono::seconds interval{5};  // a killed run loses at most about this time and one figure
  constexpr int part_of_time = 50;             // large figures: saving takes at most about 1/50 of the time
  const Clock::duration age = Clock::now() - last_save_;
  if (context_.ranks->of_first(keeps_states_ && age > std::max<Clock::duration>(interval, part_of_time * cost_)))
    save(k, known);
}

}  // namespace pseudorigid::app
