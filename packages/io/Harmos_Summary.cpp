// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Summary.hpp>

#include <detail/Harmos_AtomicFile.hpp>

#include <cmath>
#include <cstdio>

namespace Harmos
{

std::string jsonString(std::string const &text)
{
  std::string quoted = "\"";
  for (char c : text)
  {
    if (c == '"' || c == '\\')
      quoted += std::string("\\") + c;
    else if (c == '\n')
      quoted += "\\n";
    else if (c == '\t')
      quoted += "\\t";
    else if (static_cast<unsigned char>(c) < 0x20)
    {
      char escape[8];
      std::snprintf(escape, sizeof(escape), "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      quoted += escape;
    }
    else
      quoted += c;
  }
  return quoted + '"';
}

std::string jsonNumber(double value)
{
  if (!std::isfinite(value))
    return "null";
  char text[40];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

namespace
{

/// Collects "key": value members of one object, each on a line of its own.
class ObjectWriter
{
public:
  explicit ObjectWriter(int indent) : indent_(static_cast<std::size_t>(indent), ' ') {}
  void raw(std::string const &key, std::string const &value)
  {
    text_ += (text_.empty() ? "" : ",\n") + indent_ + "  " + jsonString(key) + ": " + value;
  }
  void add(std::string const &key, std::string const &value) { raw(key, jsonString(value)); }
  void add(std::string const &key, double value) { raw(key, jsonNumber(value)); }
  void add(std::string const &key, long long value) { raw(key, std::to_string(value)); }
  std::string text() const { return text_.empty() ? "{}" : "{\n" + text_ + '\n' + indent_ + '}'; }

private:
  std::string indent_;
  std::string text_;
};

template <class Pairs>
std::string nested(Pairs const &pairs)
{
  ObjectWriter object(2);
  for (auto const &[key, value] : pairs)
    object.add(key, value);
  return object.text();
}

} // namespace

std::string summaryText(Summary const &s)
{
  std::string warnings;
  for (auto const &warning : s.warnings)
    warnings += (warnings.empty() ? "" : ", ") + jsonString(warning);

  ObjectWriter object(0);
  object.add("status", s.status);
  object.add("cycles", s.cycles);
  object.add("end_time", s.end_time);
  object.add("pair_steps", s.pair_steps);
  object.add("cell_steps", s.cell_steps);
  object.add("wall_seconds", s.wall_seconds);
  object.add("cpu_seconds", s.cpu_seconds);
  object.raw("phases", nested(s.phases));
  object.add("pair_steps_per_second", s.pair_steps_per_second);
  object.add("peak_memory_bytes", s.peak_memory_bytes);
  object.add("ranks", static_cast<long long>(s.ranks));
  object.add("mass_error", s.mass_error);
  object.add("momentum_error", s.momentum_error);
  object.add("energy_error", s.energy_error);
  object.add("angular_momentum_drift", s.angular_momentum_drift);
  object.add("unconverged_cycles", s.unconverged_cycles);
  object.add("bonds", s.bonds);
  object.add("broken_bonds", s.broken_bonds);
  object.add("merged_fragments", s.merged_fragments);
  object.add("bounded_specific_volumes", s.bounded_volumes);
  object.add("slowed_light_nodes", s.slowed_light_nodes);
  object.add("repeated_cycles", s.repeated_cycles);
  object.add("closed_void_volume", s.closed_void_volume);
  object.add("gas_work", s.gas_work);
  object.add("gas_heat", s.gas_heat);
  object.add("greedy_cells", s.greedy_cells);
  object.add("unfinished_interfaces", s.unfinished_interfaces);
  if (!s.shape_errors.empty())
    object.raw("shape_errors", nested(s.shape_errors));
  object.raw("warnings", '[' + warnings + ']');
  object.raw("versions", nested(s.versions));
  object.raw("deck", s.deck_json.empty() ? "null" : s.deck_json);
  return object.text() + '\n';
}

void writeSummary(std::string const &path, Summary const &summary)
{
  writeFileAtomically(path, summaryText(summary));
}

} // namespace Harmos
