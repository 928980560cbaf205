#include "tests/postproc/pixels.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <stdexcept>

namespace pfdm::test {

Pixels read_png(const std::string& content) {
  vtkNew<vtkPNGReader> reader;
  reader->SetMemoryBuffer(content.data());
  reader->SetMemoryBufferLength(static_cast<vtkIdType>(content.size()));
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  int size[3];
  image->GetDimensions(size);
  if (image->GetNumberOfScalarComponents() != 3) throw std::runtime_error("not a PNG of three colours");
  Pixels pixels{size[0], size[1], {}};
  for (int y = pixels.height - 1; y >= 0; --y) {  // VTK's first row is the lowest
    const auto* row = static_cast<const unsigned char*>(image->GetScalarPointer(0, y, 0));
    pixels.rgb.insert(pixels.rgb.end(), row, row + 3 * static_cast<std::ptrdiff_t>(pixels.width));
  }
  return pixels;
}

}  // namespace pfdm::test
