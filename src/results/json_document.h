#pragma once

#include <string>

#include "results/json_archive.h"

namespace gapscope::internal::results {

/// One struct after the name of its schema.
template <class Struct>
Json document_of(std::string schema, Struct value) {
  JsonWriter writer;
  writer("schema", schema);
  fields(writer, value);
  return std::move(writer.json);
}

/// A file that is that.
template <class Struct>
void write_document(const std::string& path, const std::string& schema, const Struct& value,
                    const Replaceable& found = {}) {
  save_json(path, document_of(schema, value), found);
}

/// @param text  of the file  @throws ConfigError for another schema or a damaged file.
template <class Struct>
Struct parsed_document(const std::string& text, const std::string& path, const std::string& expected) {
  const Json json = parsed_json(text, path);
  JsonReader reader(json, path, "");
  reader.schema(expected);
  Struct value;
  fields(reader, value);
  return value;
}

template <class Struct>
Struct read_document(const std::string& path, const std::string& expected) {
  return parsed_document<Struct>(text_of_file(path), path, expected);
}

}  // namespace gapscope::internal::results
