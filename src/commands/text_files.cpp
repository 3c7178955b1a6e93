#include "commands/text_files.h"

#include <ostream>

#include "gapscope/base/whole_file.h"

namespace gapscope {

void write_texts(const std::string& folder, const std::vector<TextFile>& files) {
  for (const TextFile& file : files)
    write_whole_file(folder + "/" + file.name, [&](std::ostream& out) { out << file.text; });
}

}  // namespace gapscope
