#include "core/deck/named_model.hpp"

#include <fmt/format.h>

namespace treejet {

void apply_model(const std::vector<Given>& given, Parameters& parameters, Findings& findings) {
  if (parameters.model != Model::slender) return;
  Parameters meant;
  meant.self_field = SelfField::slender;
  meant.feed = Feed::flow;
  meant.surface_model = SurfaceModel::energy;
  for (const char* words : {"self field", "feed", "surface tension model"}) {
    const Directive& d = directive(words);
    const std::string value = value_text(d, meant), said = value_text(d, parameters);
    const Given* line = find(given, d);
    if (line && !line->faulty && said != value)
      findings.errors.push_back(
          {line->place, fmt::format("{0} {1}: expected {2}, as model slender at {3} says; without that line "
                                    "what it stands for can be named one by one",
                                    words, said, value, find(given, directive("model"))->place.name)});
  }
  parameters.self_field = meant.self_field;
  parameters.feed = meant.feed;
  parameters.surface_model = meant.surface_model;
}

}  // namespace treejet
