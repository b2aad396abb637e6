// Attachment: a spring between a particle and an anchor. Read by C++ and by GLSL.
#ifndef WEFT_ATTACHMENT_DATA_H
#define WEFT_ATTACHMENT_DATA_H

// The numbers of one constraint.
//   compliance  m/N  inverse stiffness of the spring
#define WEFT_ROW_attachment(FIELD) FIELD(compliance)

#endif
