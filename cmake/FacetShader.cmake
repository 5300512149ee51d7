# facet_add_shader() is defined here once the shader interface stands.
