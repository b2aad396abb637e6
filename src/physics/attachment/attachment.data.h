// Attachment: a particle tied to a place by a spring. Read by C++ and by GLSL.
#ifndef WEFT_ATTACHMENT_DATA_H
#define WEFT_ATTACHMENT_DATA_H

// The numbers of one row.
//   compliance  m/N  inverse stiffness of the spring
#define WEFT_ROW_attachment(FIELD) FIELD(compliance)

#endif
