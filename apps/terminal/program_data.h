#pragma once

#include <string>

namespace apps {

/// A folder that the program reads: `of_source`, where the sources are, as the program was built,
/// or, if that is not there, `name` below share/radiosity/ beside the installed program's bin/.
std::string program_data(const std::string& of_source, const std::string& name);

}  // namespace apps
